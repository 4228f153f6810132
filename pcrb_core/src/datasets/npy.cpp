#include <algorithm>
#include <limits>
#include <optional>

#include "datasets/records.hpp"
#include "pcrb_core/datasets/cloud_file.hpp"
#include "pcrb_core/error.hpp"
#include "pcrb_core/io/foreign_data.hpp"
#include "pcrb_core/io/number.hpp"
#include "pcrb_core/io/text.hpp"

namespace pcrb {
namespace {

constexpr std::string_view kNpyMagic = "\x93NUMPY";
constexpr std::size_t kLongestRow = 1 << 20;  ///< numbers, or bytes between two fields
constexpr const char* kNpyExpected =
    "an array of N x 3 or more float32 or float64, or of records with fields x y z, as numpy.save "
    "writes it";

/// The header's dictionary, a text like `{'descr': '<f4', 'fortran_order': False, 'shape': (3, 4),
/// }`, and the bytes behind it.
struct NpyParts {
  std::string_view header;
  std::string_view data;
};

NpyParts splitNpy(std::string_view bytes, const std::string& name) {
  constexpr std::size_t kVersion = 6;
  if (bytes.size() < 12 || bytes.substr(0, kNpyMagic.size()) != kNpyMagic) {
    throw InvalidFile(name, 0, "another beginning", kNpyExpected);
  }
  const std::size_t length_bytes = bytes[kVersion] == 1 ? 2 : 4;
  const std::size_t begin = 8 + length_bytes;
  const RecordField length{8, 'u', length_bytes};
  const auto size = static_cast<std::size_t>(loadNumber(bytes.data(), length, false));
  if (size > bytes.size() - begin) throw InvalidFile(name, 0, "a cut header", kNpyExpected);
  return {bytes.substr(begin, size), bytes.substr(begin + size)};
}

/// What follows a key, up to the next key or the end.
std::string_view valueOf(std::string_view header, const std::string& key, const std::string& name) {
  const std::size_t at = header.find("'" + key + "':");
  if (at == std::string_view::npos) {
    throw InvalidFile(name, 0, "no " + inQuotes(key) + " in " + inQuotes(header), kNpyExpected);
  }
  return trimmed(header.substr(at + key.size() + 3));
}

/// `(12, 4)` as numbers; empty for anything else.
std::vector<std::size_t> shapeOf(std::string_view value) {
  std::vector<std::string_view> words;
  std::vector<std::size_t> shape;
  if (!startsWith(value, "(")) return shape;
  splitAt(',', value.substr(1, value.find(')') - 1), words);
  for (const std::string_view word : words) {
    if (const auto number = parseUnsigned(word)) shape.push_back(*number);
  }
  return shape;
}

/// `<f4` and the like.
std::optional<RecordField> typeOf(std::string_view text, bool& big_endian) {
  if (text.size() < 3) return std::nullopt;
  const std::size_t size = parseUnsigned(text.substr(2)).value_or(0);
  const bool is_float = text[1] == 'f' && (size == 4 || size == 8);
  const bool is_integer = (text[1] == 'i' || text[1] == 'u') && size >= 1 && size <= 8;
  if (!is_float && !is_integer) return std::nullopt;
  big_endian |= text[0] == '>';
  return RecordField{0, text[1], size};
}

/// The text between the next two quotes, which is taken away with all before it.
std::optional<std::string_view> takeQuotedText(std::string_view& text) {
  const std::size_t begin = text.find('\'');
  const std::size_t end = begin == std::string_view::npos ? begin : text.find('\'', begin + 1);
  if (end == std::string_view::npos) return std::nullopt;
  const std::string_view inside = text.substr(begin + 1, end - begin - 1);
  text.remove_prefix(end + 1);
  return inside;
}

/// The layout of `[('x', '<f4'), ('y', '<f4'), …]`.
RecordLayout recordsLayout(std::string_view descr, const std::string& name) {
  descr = descr.substr(0, descr.find(']'));
  std::vector<NamedField> fields;
  std::size_t length = 0;
  bool big_endian = false;
  while (const auto field_name = takeQuotedText(descr)) {
    const std::string_view type_name = takeQuotedText(descr).value_or("");
    const auto padding =
        startsWith(type_name, "|V") ? parseUnsigned(type_name.substr(2)) : std::nullopt;
    const auto type = typeOf(type_name, big_endian);
    if (!type && !(padding && *padding < kLongestRow)) {
      throw InvalidFile(name, 0, "the type of the field " + inQuotes(*field_name), kNpyExpected);
    }
    if (type) fields.push_back({std::string(*field_name), {length, type->kind, type->size}});
    length += type ? type->size : *padding;
  }
  return layoutOf(fields, length, big_endian, name);
}

std::size_t product(const std::vector<std::size_t>& shape, const std::string& name) {
  std::size_t count = 1;
  for (const std::size_t size : shape) {
    if (size != 0 && count > std::numeric_limits<std::size_t>::max() / 64 / size) {
      throw InvalidFile(name, 0, "an impossible shape", kNpyExpected);
    }
    count *= size;
  }
  return count;
}

/// The layout of rows of numbers, the first three of which are a point.
RecordLayout rowsLayout(std::string_view descr, std::size_t columns, const std::string& name) {
  bool big_endian = false;
  const auto quoted = takeQuotedText(descr);
  const auto type = quoted ? typeOf(*quoted, big_endian) : std::nullopt;
  if (!type || type->kind != 'f' || type->size < 4) {
    throw InvalidFile(name, 0, "numbers of type " + inQuotes(quoted.value_or("")), kNpyExpected);
  }
  RecordLayout layout;
  layout.big_endian = big_endian;
  layout.length = columns * type->size;
  layout.x = {0, 'f', type->size};
  layout.y = {type->size, 'f', type->size};
  layout.z = {2 * type->size, 'f', type->size};
  return layout;
}

/// An array that lies column by column: each coordinate's numbers are together.
SensorScan readColumns(std::string_view data, std::size_t rows, const RecordLayout& layout,
                       OriginPoints origin, const std::string& name) {
  if (data.size() / layout.length < rows) throw InvalidFile(name, 0, "too few bytes", kNpyExpected);
  const std::size_t size = layout.x.size;
  SensorScan scan;
  for (std::size_t i = 0; i != rows; ++i) {
    const auto number = [&](std::size_t column) {
      return loadNumber(data.data(), {(column * rows + i) * size, 'f', size}, layout.big_endian);
    };
    scan.add({number(0), number(1), number(2)}, origin);
  }
  return scan;
}

}  // namespace

SensorScan parseNpy(std::string_view bytes, OriginPoints origin, const std::string& name) {
  requireData(bytes, name);
  const NpyParts parts = splitNpy(bytes, name);
  const std::string_view descr = valueOf(parts.header, "descr", name);
  const std::string_view shape_text = valueOf(parts.header, "shape", name);
  std::vector<std::size_t> shape = shapeOf(shape_text);
  if (startsWith(descr, "[")) {
    return readRecords(parts.data, product(shape, name), recordsLayout(descr, name), origin, name);
  }
  if (shape.size() < 2 || shape.size() > 3 || shape.back() < 3 || shape.back() > kLongestRow) {
    throw InvalidFile(
        name, 0, "an array of shape " + inQuotes(shape_text.substr(0, shape_text.find(')') + 1)),
        kNpyExpected);
  }
  const RecordLayout layout = rowsLayout(descr, shape.back(), name);
  shape.pop_back();
  const bool by_columns = startsWith(valueOf(parts.header, "fortran_order", name), "True");
  if (by_columns && shape.size() > 1) {
    throw InvalidFile(name, 0, "three axes in Fortran's order", kNpyExpected);
  }
  const std::size_t rows = product(shape, name);
  return by_columns ? readColumns(parts.data, rows, layout, origin, name)
                    : readRecords(parts.data, rows, layout, origin, name);
}

}  // namespace pcrb
