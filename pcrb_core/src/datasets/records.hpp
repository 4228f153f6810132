#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "pcrb_core/datasets/sensor_scan.hpp"

namespace pcrb {

/// A number in a record: `f4` is a float32, as numpy calls it.
struct RecordField {
  std::size_t offset = 0;  ///< bytes from the record's start
  char kind = 'f';         ///< f: float; i: signed; u: unsigned integer
  std::size_t size = 4;    ///< bytes
};

/// Records of one length, one behind the other.
struct RecordLayout {
  std::size_t length = 0;  ///< bytes of a record
  bool big_endian = false;
  RecordField x, y, z;
  std::optional<RecordField> time;
  double time_scale = 1.0;  ///< s of a unit of `time`
};

/// The number of a field of a record that begins at `record`.
double loadNumber(const char* record, const RecordField& field, bool big_endian);

/// A named field, and where it lies.
struct NamedField {
  std::string name;
  RecordField field;
};

/// The layout of records with such fields.
/// @throws InvalidFile  unless there are x, y and z as float32 or float64, naming those there are.
RecordLayout layoutOf(const std::vector<NamedField>& fields, std::size_t length, bool big_endian,
                      const std::string& name);

/// @throws InvalidFile  if there are fewer bytes.
SensorScan readRecords(std::string_view bytes, std::size_t count, const RecordLayout& layout,
                       OriginPoints origin, const std::string& name);

}  // namespace pcrb
