#include <lzf.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <memory>
#include <string_view>

#include "pcd_header.hpp"

namespace pcrb {
namespace {

static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__, "PCD data is little-endian");

/// Old versions of PCL filled files up with zeros, by less than a page.
constexpr std::size_t kLargestFill = 4096;

/// Most bytes that one byte of LZF data can stand for: 264 from 3.
constexpr std::size_t kLzfLargestRatio = 88;

template <typename Number>
double load(const char* bytes) {
  Number value;
  std::memcpy(&value, bytes, sizeof(value));
  return static_cast<double>(value);
}

double loadFloat(const PcdField& field, const char* bytes) {
  return field.size == 4 ? load<float>(bytes) : load<double>(bytes);
}

/// An integer of 1, 2, 4 or 8 bytes.
template <typename One, typename Two, typename Four, typename Eight>
double loadInteger(const PcdField& field, const char* bytes) {
  switch (field.size) {
    case 1:
      return load<One>(bytes);
    case 2:
      return load<Two>(bytes);
    case 4:
      return load<Four>(bytes);
    default:
      return load<Eight>(bytes);
  }
}

/// Where the values of one field lie: in rows (binary) or together (binary_compressed).
struct BinaryColumn {
  PcdField field;
  const char* first = nullptr;
  std::size_t stride = 0;

  double at(std::size_t i) const {
    const char* const bytes = first + i * stride;
    if (field.type == 'F') return loadFloat(field, bytes);
    if (field.type == 'I') {
      return loadInteger<std::int8_t, std::int16_t, std::int32_t, std::int64_t>(field, bytes);
    }
    return loadInteger<std::uint8_t, std::uint16_t, std::uint32_t, std::uint64_t>(field, bytes);
  }
};

void collect(const PcdHeader& header, const std::vector<BinaryColumn>& columns, TimedCloud& cloud) {
  const BinaryColumn& x = columns[header.find(PcdUse::kX)];
  const BinaryColumn& y = columns[header.find(PcdUse::kY)];
  const BinaryColumn& z = columns[header.find(PcdUse::kZ)];
  const std::size_t intensity = header.find(PcdUse::kIntensity);
  const std::size_t time = header.find(PcdUse::kTime);
  cloud.points.reserve(header.points);
  if (intensity < columns.size()) cloud.intensity.reserve(header.points);
  for (std::size_t i = 0; i < header.points; ++i) {
    const Eigen::Vector3d point(x.at(i), y.at(i), z.at(i));
    if (!point.allFinite()) {
      ++cloud.dropped_non_finite;
      continue;
    }
    cloud.points.push_back(point);
    if (intensity < columns.size()) {
      cloud.intensity.push_back(static_cast<float>(columns[intensity].at(i)));
    }
    if (time < columns.size()) {
      cloud.times.push_back(columns[time].at(i) * columns[time].field.timeScale());
    }
  }
}

std::size_t rowBytes(const PcdHeader& header, bool with_padding) {
  std::size_t bytes = 0;
  for (const PcdField& field : header.fields) {
    if (with_padding || !field.isPadding()) bytes += field.bytes();
  }
  return bytes;
}

/// Whether `size` bytes are exactly, or at least, `points` rows; the product may not fit.
bool isExactly(std::size_t size, std::size_t points, std::size_t row_bytes) {
  return points == 0 ? size == 0 : size % points == 0 && size / points == row_bytes;
}
bool isAtLeast(std::size_t size, std::size_t points, std::size_t row_bytes) {
  return points == 0 || size / points >= row_bytes;
}

std::string describe(const PcdHeader& header, std::size_t row_bytes) {
  return std::to_string(header.points) + " points of " + std::to_string(row_bytes) + " bytes";
}

bool isFill(std::string_view rest) {
  return rest.size() < kLargestFill && rest.find_first_not_of('\0') == std::string_view::npos;
}

/// The uncompressed values, field after field; PCL leaves padding out, others may not.
void collectFields(const PcdHeader& header, const LineReader& lines, std::string_view values,
                   TimedCloud& cloud) {
  const bool with_padding = !isExactly(values.size(), header.points, rowBytes(header, false));
  if (with_padding && !isExactly(values.size(), header.points, rowBytes(header, true))) {
    lines.fail(std::to_string(values.size()) + " bytes of uncompressed data",
               describe(header, rowBytes(header, false)));
  }
  std::vector<BinaryColumn> columns;
  const char* first = values.data();
  for (const PcdField& field : header.fields) {
    columns.push_back({field, first, field.bytes()});
    if (with_padding || !field.isPadding()) first += header.points * field.bytes();
  }
  collect(header, columns, cloud);
}

/// Decodes LZF data of exactly `size` bytes into `values`; whether it is well-formed and that long.
bool decodeLzf(std::string_view data, char* values, std::size_t size) {
  if (data.empty()) return size == 0;  // the library reads one byte in any case
  return lzf_decompress(data.data(), static_cast<unsigned>(data.size()), values,
                        static_cast<unsigned>(size)) == size;
}

}  // namespace

void readPcdBinary(const PcdHeader& header, const LineReader& lines, const PcdReading& options,
                   TimedCloud& cloud) {
  const std::string_view data = lines.rest();
  const std::size_t row_bytes = rowBytes(header, true);
  if (!isAtLeast(data.size(), header.points, row_bytes) ||
      !isFill(data.substr(header.points * row_bytes))) {
    lines.fail(std::to_string(data.size()) + " bytes of data", describe(header, row_bytes));
  }
  const auto share = takeMemory(lines, data.size() + pointBytes(header, header.points), options);
  std::vector<BinaryColumn> columns;
  const char* first = data.data();
  for (const PcdField& field : header.fields) {
    columns.push_back({field, first, row_bytes});
    first += field.bytes();
  }
  collect(header, columns, cloud);
}

void readPcdCompressed(const PcdHeader& header, const LineReader& lines, const PcdReading& options,
                       TimedCloud& cloud) {
  std::string_view data = lines.rest();
  std::uint32_t sizes[2];
  if (data.size() < sizeof(sizes)) {
    lines.fail(std::to_string(data.size()) + " bytes of data", "8 bytes with two sizes");
  }
  std::memcpy(sizes, data.data(), sizeof(sizes));
  data.remove_prefix(sizeof(sizes));
  const std::size_t compressed = sizes[0];
  const std::size_t uncompressed = sizes[1];
  if (data.size() < compressed || !isFill(data.substr(compressed))) {
    lines.fail(std::to_string(data.size()) + " bytes of compressed data",
               std::to_string(compressed) + " bytes");
  }
  if (uncompressed > compressed * kLzfLargestRatio) {
    lines.fail(std::to_string(uncompressed) + " bytes claimed to be in " +
                   std::to_string(compressed) + " bytes of LZF data",
               "at most " + std::to_string(kLzfLargestRatio) + " times as many");
  }
  // More points than bytes are a lie, which is said below.
  const std::size_t points = std::min(header.points, uncompressed);
  const auto share =
      takeMemory(lines, data.size() + uncompressed + pointBytes(header, points), options);
  const std::unique_ptr<char[]> values(new char[uncompressed]);
  if (!decodeLzf(data.substr(0, compressed), values.get(), uncompressed)) {
    lines.fail("broken LZF data", std::to_string(uncompressed) + " bytes after decoding");
  }
  collectFields(header, lines, {values.get(), uncompressed}, cloud);
}

}  // namespace pcrb
