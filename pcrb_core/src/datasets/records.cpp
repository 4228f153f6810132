#include "datasets/records.hpp"

#include <cstdint>

#include "pcrb_core/error.hpp"
#include "pcrb_core/io/byte_order.hpp"
#include "pcrb_core/io/pcd.hpp"

namespace pcrb {
namespace {

bool isFloat(const RecordField& field) { return field.kind == 'f'; }

}  // namespace

double loadNumber(const char* record, const RecordField& field, bool big_endian) {
  const char* const bytes = record + field.offset;
  if (isFloat(field)) {
    return field.size == 4 ? static_cast<double>(loadFloat<float>(bytes, big_endian))
                           : loadFloat<double>(bytes, big_endian);
  }
  const std::uint64_t bits = loadUnsigned(bytes, field.size, big_endian);
  const unsigned unused = 64U - 8U * static_cast<unsigned>(field.size);
  if (field.kind == 'i') {
    return static_cast<double>(static_cast<std::int64_t>(bits << unused) >> unused);
  }
  return static_cast<double>(bits);
}

RecordLayout layoutOf(const std::vector<NamedField>& fields, std::size_t length, bool big_endian,
                      const std::string& name) {
  RecordLayout layout;
  layout.length = length;
  layout.big_endian = big_endian;
  std::string names;
  int found = 0;
  for (const NamedField& field : fields) {
    names += (names.empty() ? "" : " ") + field.name;
    const bool is_axis = isFloat(field.field) && field.name.size() == 1;
    const std::size_t axis = is_axis ? std::string_view("xyz").find(field.name[0]) : 3;
    if (axis < 3) {
      (axis == 0 ? layout.x : axis == 1 ? layout.y : layout.z) = field.field;
      ++found;
    }
    const double scale = pointTimeScale(field.name, isFloat(field.field));
    if (scale > 0.0 && !layout.time) {
      layout.time = field.field;
      layout.time_scale = scale;
    }
  }
  if (found != 3) {
    throw InvalidFile(name, 0, "the fields " + names, "x, y and z as float32 or float64");
  }
  return layout;
}

SensorScan readRecords(std::string_view bytes, std::size_t count, const RecordLayout& layout,
                       OriginPoints origin, const std::string& name) {
  if (bytes.size() / layout.length < count) {
    throw InvalidFile(name, 0, std::to_string(bytes.size()) + " bytes of points",
                      std::to_string(count) + " points of " + std::to_string(layout.length) +
                          " bytes: is the file cut?");
  }
  SensorScan scan;
  scan.points.reserve(count);
  if (layout.time) scan.times.reserve(count);
  for (std::size_t i = 0; i != count; ++i) {
    const char* const record = bytes.data() + i * layout.length;
    const auto number = [&](const RecordField& field) {
      return loadNumber(record, field, layout.big_endian);
    };
    const bool is_kept = scan.add({number(layout.x), number(layout.y), number(layout.z)}, origin);
    if (is_kept && layout.time) scan.times.push_back(number(*layout.time) * layout.time_scale);
  }
  return scan;
}

}  // namespace pcrb
