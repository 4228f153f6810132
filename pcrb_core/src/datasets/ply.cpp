#include <algorithm>
#include <array>
#include <optional>

#include "datasets/records.hpp"
#include "pcrb_core/datasets/cloud_file.hpp"
#include "pcrb_core/error.hpp"
#include "pcrb_core/io/number.hpp"
#include "pcrb_core/io/text.hpp"

namespace pcrb {
namespace {

struct PlyType {
  std::string_view name;
  char kind;
  std::size_t size;
};

constexpr std::array<PlyType, 16> kPlyTypes{{{"char", 'i', 1},
                                             {"int8", 'i', 1},
                                             {"uchar", 'u', 1},
                                             {"uint8", 'u', 1},
                                             {"short", 'i', 2},
                                             {"int16", 'i', 2},
                                             {"ushort", 'u', 2},
                                             {"uint16", 'u', 2},
                                             {"int", 'i', 4},
                                             {"int32", 'i', 4},
                                             {"uint", 'u', 4},
                                             {"uint32", 'u', 4},
                                             {"float", 'f', 4},
                                             {"float32", 'f', 4},
                                             {"double", 'f', 8},
                                             {"float64", 'f', 8}}};

/// What the header says of the vertices, which must be the first element.
struct PlyHeader {
  std::string format;  ///< ascii, binary_little_endian, binary_big_endian
  std::size_t vertices = 0;
  std::vector<NamedField> fields;
  std::size_t length = 0;  ///< bytes of a binary vertex
};

class PlyHeaderReader {
 public:
  explicit PlyHeaderReader(LineReader& reader) : reader_(reader) {}

  PlyHeader read() {
    std::string_view line;
    if (!reader_.next(line) || trimmed(line) != "ply") {
      reader_.fail(inQuotes(line.substr(0, 20)), "`ply`: a PLY file");
    }
    while (reader_.next(line)) {
      splitAtBlanks(line, words_);
      if (words_.empty() || words_[0] == "comment" || words_[0] == "obj_info") continue;
      if (words_[0] == "end_header") return finished();
      take(line);
    }
    reader_.fail("the end of the file", "`end_header`");
  }

 private:
  void take(std::string_view line) {
    if (words_[0] == "format" && words_.size() == 3) {
      header_.format = words_[1];
    } else if (words_[0] == "element" && words_.size() == 3) {
      takeElement();
    } else if (words_[0] == "property") {
      if (in_vertex_) takeProperty(line);
    } else {
      reader_.fail(inQuotes(line), "format, element, property, comment or end_header");
    }
  }

  void takeElement() {
    in_vertex_ = words_[1] == "vertex";
    const auto count = parseUnsigned(words_[2]);
    if (!count) reader_.fail(inQuotes(words_[2]), "a number of elements");
    if (in_vertex_) {
      header_.vertices = *count;
      has_vertex_ = true;
    } else if (!has_vertex_ && *count > 0) {
      reader_.fail("the element " + inQuotes(words_[1]) + " before the vertices", "element vertex");
    }
  }

  void takeProperty(std::string_view line) {
    if (words_.size() != 3) reader_.fail(inQuotes(line), "`property TYPE NAME` of a vertex");
    const auto type = std::find_if(kPlyTypes.begin(), kPlyTypes.end(),
                                   [&](const PlyType& known) { return known.name == words_[1]; });
    if (type == kPlyTypes.end()) reader_.fail(inQuotes(words_[1]), "a type of PLY");
    header_.fields.push_back({std::string(words_[2]), {header_.length, type->kind, type->size}});
    header_.length += type->size;
  }

  PlyHeader finished() const {
    const std::string& format = header_.format;
    if (format != "ascii" && format != "binary_little_endian" && format != "binary_big_endian") {
      reader_.fail("the format " + inQuotes(format),
                   "ascii, binary_little_endian or binary_big_endian");
    }
    if (!has_vertex_) reader_.fail("no element vertex", "one");
    return header_;
  }

  LineReader& reader_;
  PlyHeader header_;
  std::vector<std::string_view> words_;
  bool in_vertex_ = false;
  bool has_vertex_ = false;
};

/// The columns of a text that are read.
struct PlyColumns {
  std::array<std::size_t, 3> axes{};
  std::optional<std::size_t> time;
};

PlyColumns columnsOf(const PlyHeader& header, const RecordLayout& layout) {
  PlyColumns columns;
  for (std::size_t i = 0; i != header.fields.size(); ++i) {
    const std::size_t offset = header.fields[i].field.offset;
    const std::array<std::size_t, 3> offsets{layout.x.offset, layout.y.offset, layout.z.offset};
    const auto axis = std::find(offsets.begin(), offsets.end(), offset);
    if (axis != offsets.end()) columns.axes[static_cast<std::size_t>(axis - offsets.begin())] = i;
    if (layout.time && layout.time->offset == offset) columns.time = i;
  }
  return columns;
}

double requireNumber(const LineReader& reader, std::string_view word) {
  const auto number = parseDouble(word);
  if (!number) reader.fail(inQuotes(word), "a number");
  return *number;
}

SensorScan readPlyText(LineReader& reader, const PlyHeader& header, OriginPoints origin) {
  const RecordLayout layout = layoutOf(header.fields, header.length, false, reader.name());
  const PlyColumns columns = columnsOf(header, layout);
  SensorScan scan;
  std::vector<std::string_view> words;
  std::string_view line;
  for (std::size_t i = 0; i != header.vertices; ++i) {
    if (!reader.nextRow(line)) {
      reader.fail("the end after " + std::to_string(i) + " vertices",
                  std::to_string(header.vertices));
    }
    splitAtBlanks(line, words);
    if (words.size() != header.fields.size()) {
      reader.fail(inQuotes(line) + " (" + std::to_string(words.size()) + " fields)",
                  std::to_string(header.fields.size()) + " numbers of a vertex");
    }
    Eigen::Vector3d point;
    for (std::size_t axis = 0; axis != columns.axes.size(); ++axis) {
      point[static_cast<Eigen::Index>(axis)] = requireNumber(reader, words[columns.axes[axis]]);
    }
    if (scan.add(point, origin) && columns.time) {
      scan.times.push_back(requireNumber(reader, words[*columns.time]) * layout.time_scale);
    }
  }
  return scan;
}

}  // namespace

SensorScan parsePly(std::string_view bytes, OriginPoints origin, const std::string& name) {
  LineReader reader(bytes, name);
  const PlyHeader header = PlyHeaderReader(reader).read();
  if (header.format == "ascii") return readPlyText(reader, header, origin);
  const bool big_endian = header.format == "binary_big_endian";
  return readRecords(reader.rest(), header.vertices,
                     layoutOf(header.fields, header.length, big_endian, name), origin, name);
}

}  // namespace pcrb
