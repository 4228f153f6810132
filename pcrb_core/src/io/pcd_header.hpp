#pragma once

#include <cstddef>
#include <mutex>
#include <string>
#include <vector>

#include "pcrb_core/io/pcd.hpp"
#include "pcrb_core/io/text.hpp"
#include "pcrb_core/point_cloud.hpp"
#include "pcrb_core/transform.hpp"

namespace pcrb {

enum class PcdData { kAscii, kBinary, kBinaryCompressed };

/// What the values of a field become.
enum class PcdUse { kX, kY, kZ, kIntensity, kTime, kNone };
constexpr std::size_t kPcdUses = 6;

/// One entry of FIELDS with what SIZE, TYPE and COUNT say about it.
struct PcdField {
  std::string name;
  std::size_t size = 0;   ///< bytes of one element
  char type = 'F';        ///< F, I or U
  std::size_t count = 1;  ///< elements
  PcdUse use = PcdUse::kNone;

  std::size_t bytes() const { return size * count; }
  bool isPadding() const { return name == "_"; }
  double timeScale() const { return pointTimeScale(name, type == 'F'); }
};

/// Comment of a header whose VIEWPOINT is a sensor's pose although it is the identity, as that of a
/// trajectory's first scan may be.
inline constexpr const char* kViewpointComment = "# VIEWPOINT is the sensor's pose";

/// A checked PCD header: its entries agree with each other, not yet with the data.
struct PcdHeader {
  std::vector<PcdField> fields;  ///< x, y, z are used: once, TYPE F, COUNT 1
  std::size_t points = 0;
  Transform viewpoint = Transform::Identity();
  bool is_viewpoint_known = false;  ///< a comment says so
  PcdData data = PcdData::kAscii;
  std::vector<std::string> notes;  ///< what was taken although it is not as it should be

  /// Index of the field with this use, or fields.size().
  std::size_t find(PcdUse use) const;
  bool has(PcdUse use) const { return find(use) < fields.size(); }
};

/// Takes the lines of `lines` up to the DATA entry and checks them.
///
/// Entries in any order, DATA last; VERSION, COUNT and VIEWPOINT may be missing.
/// @param with_times  whether the times of the points are used
/// @throws InvalidFile  with the line, what was found and what was expected.
PcdHeader readPcdHeader(LineReader& lines, bool with_times);

/// How a PCD file is read.
struct PcdReading : PcdReadOptions {
  /// Held by who reads a file before it knows its share of the budget: one at a time has bytes that
  /// no share is for, and unlocks when it has one.
  std::unique_lock<std::mutex>* turn = nullptr;
};

// Readers of what follows a PCD header. `lines` stands behind the DATA entry; they fill points,
// intensity, times, dropped_non_finite and notes, and throw InvalidFile, also where file and
// cloud need more than the budget.

void readPcdAscii(const PcdHeader& header, const LineReader& lines, const PcdReading& options,
                  TimedCloud& cloud);
void readPcdBinary(const PcdHeader& header, const LineReader& lines, const PcdReading& options,
                   TimedCloud& cloud);
void readPcdCompressed(const PcdHeader& header, const LineReader& lines, const PcdReading& options,
                       TimedCloud& cloud);

/// Bytes of so many points in a DatasetCloud.
inline std::size_t pointBytes(const PcdHeader& header, std::size_t points) {
  return points * (sizeof(Eigen::Vector3d) + (header.has(PcdUse::kIntensity) ? sizeof(float) : 0) +
                   (header.has(PcdUse::kTime) ? sizeof(double) : 0));
}

/// Waits for a share of the budget, and ends the turn.
/// @throws InvalidFile  if more bytes are needed than there are in all.
MemoryBudget::Share takeMemory(const LineReader& lines, std::size_t needed,
                               const PcdReading& options);

}  // namespace pcrb
