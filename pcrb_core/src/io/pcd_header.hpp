#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "pcrb_core/io/text.hpp"
#include "pcrb_core/point_cloud.hpp"
#include "pcrb_core/transform.hpp"

namespace pcrb {

enum class PcdData { kAscii, kBinary, kBinaryCompressed };

/// One entry of FIELDS with what SIZE, TYPE and COUNT say about it.
struct PcdField {
  std::string name;
  std::size_t size = 0;   ///< bytes of one element
  char type = 'F';        ///< F, I or U
  std::size_t count = 1;  ///< elements

  std::size_t bytes() const { return size * count; }
  bool isPadding() const { return name == "_"; }
};

/// A checked PCD header: its entries agree with each other, not yet with the data.
struct PcdHeader {
  std::vector<PcdField> fields;  ///< x, y, z are among them: once, TYPE F, COUNT 1
  std::size_t points = 0;
  Transform viewpoint = Transform::Identity();
  PcdData data = PcdData::kAscii;

  /// Index of the field with this name, or fields.size().
  std::size_t find(const std::string& name) const;
};

/// Takes the lines of `lines` up to the DATA entry and checks them.
///
/// Entries in any order, DATA last; VERSION, COUNT and VIEWPOINT may be missing.
/// @throws InvalidFile  with the line, what was found and what was expected.
PcdHeader readPcdHeader(LineReader& lines);

// Readers of what follows a PCD header. `lines` stands behind the DATA entry; they fill points,
// intensity and dropped_non_finite, and throw InvalidFile.

void readPcdAscii(const PcdHeader& header, const LineReader& lines, int threads,
                  DatasetCloud& cloud);
void readPcdBinary(const PcdHeader& header, const LineReader& lines, DatasetCloud& cloud);
void readPcdCompressed(const PcdHeader& header, const LineReader& lines, DatasetCloud& cloud);

}  // namespace pcrb
