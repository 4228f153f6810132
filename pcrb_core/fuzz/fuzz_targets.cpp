#include <algorithm>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

#include "pcrb_core/datasets/cloud_file.hpp"
#include "pcrb_core/datasets/eth.hpp"
#include "pcrb_core/datasets/kaist.hpp"
#include "pcrb_core/datasets/planetary.hpp"
#include "pcrb_core/datasets/pose_file.hpp"
#include "pcrb_core/datasets/tum.hpp"
#include "pcrb_core/error.hpp"
#include "pcrb_core/io/csv.hpp"
#include "pcrb_core/io/memory_budget.hpp"
#include "pcrb_core/io/number.hpp"
#include "pcrb_core/io/pcd.hpp"
#include "pcrb_core/problem/overlap_matrix.hpp"
#include "pcrb_core/problem/problem.hpp"

// The fuzz targets. Each is a program of its own: this file with PCRB_FUZZ_TARGET set to the
// function's name.

namespace {

void require(bool claim) {
  if (!claim) __builtin_trap();
}

/// Runs a reader, which may refuse the input by an error of the suite, and by nothing else.
template <typename Reader>
void tryToRead(const Reader& reader) {
  try {
    reader();
  } catch (const pcrb::Error&) {
  }
}

void requireFinite(const pcrb::Trajectory& trajectory) {
  for (const auto stamp : {trajectory.firstStamp(), trajectory.lastStamp(),
                           trajectory.firstStamp() / 2 + trajectory.lastStamp() / 2}) {
    require(trajectory.interpolate(stamp, 100 * pcrb::kSecond).T_world_body.matrix().allFinite());
  }
}

/// What is accepted keeps the reader's promises: finite points, one intensity each or none.
[[maybe_unused]] void pcd_fuzzer(std::string_view text) {
  tryToRead([&] {
    const pcrb::DatasetCloud cloud =
        pcrb::parsePcd(text.data(), text.data() + text.size(), "fuzz.pcd");
    for (const auto& point : cloud.points) require(point.allFinite());
    require(cloud.intensity.empty() || cloud.intensity.size() == cloud.points.size());
    require(cloud.viewpoint.matrix().allFinite());
  });
}

/// What is accepted can be written, and is then a fixed point.
[[maybe_unused]] void problem_file_fuzzer(std::string_view text) {
  std::string written;
  tryToRead([&] {
    written = pcrb::formatProblemFile(
        pcrb::parseProblemFile(text.data(), text.data() + text.size(), "fuzz.txt"));
  });
  if (written.empty()) return;
  const auto again =
      pcrb::parseProblemFile(written.data(), written.data() + written.size(), "again.txt");
  require(pcrb::formatProblemFile(again) == written);
}

[[maybe_unused]] void overlap_matrix_fuzzer(std::string_view text) {
  tryToRead([&] {
    const auto matrix =
        pcrb::parseOverlapMatrix(text.data(), text.data() + text.size(), "fuzz.txt");
    require(matrix.values.size() == matrix.names.size() * matrix.names.size());
  });
}

/// The fast paths agree with std::from_chars and std::to_chars to the bit, wherever they stop.
[[maybe_unused]] void number_fuzzer(std::string_view input) {
  if (input.substr(0, 1) == "+") return;  // the one difference, tested elsewhere
  // Padded: only inside a longer text is the fast path open.
  const std::string text = std::string(input) + std::string(40, ' ');
  const char* const end = text.data() + text.size();
  double expected = 0.0;
  const auto result = std::from_chars(text.data(), end, expected);
  double value = 0.0;
  const char* const behind = pcrb::scanDouble(text.data(), end, value);
  require(behind == (result.ec == std::errc() ? result.ptr : nullptr));
  if (behind == nullptr) return;
  require(std::memcmp(&value, &expected, sizeof(value)) == 0);
  char shortest[64];
  char* const last = std::to_chars(shortest, shortest + sizeof(shortest), value).ptr;
  require(pcrb::formatShortest(value) == std::string(shortest, last));
}

/// What is read and written again is read back as it is, but for a CR: with a line end behind it,
/// it is read as a part of that, in quotes, too.
[[maybe_unused]] void csv_fuzzer(std::string_view text) {
  tryToRead([&] {
    pcrb::LineReader lines(text, "fuzz.csv");
    std::vector<std::string> row;
    while (pcrb::nextCsvRow(lines, row)) {
      row.insert(row.begin(), "row");  // a row of one empty field is a blank line
      for (std::string& field : row)
        field.erase(std::remove(field.begin(), field.end(), '\r'), field.end());
      std::string line;
      for (const std::string& field : row) {
        if (&field != &row.front()) line += ',';
        pcrb::appendCsvField(line, field);
      }
      pcrb::LineReader written(line, "again.csv");
      std::vector<std::string> again;
      require(pcrb::nextCsvRow(written, again) && again == row);
      require(!pcrb::nextCsvRow(written, again));
    }
  });
}

[[maybe_unused]] void eth_scan_fuzzer(std::string_view text) {
  tryToRead([&] {
    const pcrb::SensorScan scan = pcrb::parseEthScan(text, "fuzz.csv");
    require(scan.points.size() == scan.counts.written());
  });
}

[[maybe_unused]] void kaist_calibration_fuzzer(std::string_view text) {
  tryToRead([&] { require(pcrb::parseKaistCalibration(text, "fuzz.txt").matrix().allFinite()); });
}

[[maybe_unused]] void velodyne_scan_fuzzer(std::string_view bytes) {
  for (const auto origin : {pcrb::OriginPoints::kKeep, pcrb::OriginPoints::kDrop}) {
    tryToRead([&] {
      const pcrb::SensorScan scan = pcrb::parseVelodyneScan(bytes, origin, "fuzz.bin");
      require(scan.points.size() == scan.counts.written());
    });
  }
}

/// The first byte chooses the format.
[[maybe_unused]] void cloud_file_fuzzer(std::string_view input) {
  if (input.empty()) return;
  constexpr const char* kNames[] = {"fuzz.ply", "fuzz.npy", "fuzz.bin"};
  tryToRead([&] {
    const pcrb::SensorScan scan =
        pcrb::parseCloudFile(input.substr(1), kNames[static_cast<unsigned char>(input[0]) % 3], {});
    require(scan.points.size() == scan.counts.written());
    require(scan.times.empty() || scan.times.size() == scan.points.size());
    for (const auto& point : scan.points) require(point.allFinite());
  });
}

/// The first byte chooses the reader.
[[maybe_unused]] void log_poses_fuzzer(std::string_view input) {
  if (input.empty()) return;
  const std::string_view text = input.substr(1);
  tryToRead([&] {
    switch (static_cast<unsigned char>(input.front()) % 9) {
      case 0:
        pcrb::parseLeicaPoses(text, "fuzz.txt");
        break;
      case 1:
        pcrb::parsePlanetaryPose(text, "fuzz.txt");
        break;
      case 2:
        requireFinite(pcrb::parseTrajectory(text, "fuzz.txt").trajectory);
        break;
      case 3:
        requireFinite(pcrb::parseKaistTrajectory(text, "fuzz.txt"));
        break;
      case 4:
        pcrb::parseTumImageList(text, "fuzz.txt");
        break;
      case 5:
        pcrb::parseKaistStamps(text, "fuzz.txt");
        break;
      case 6:
        pcrb::parsePlanetaryScan(text, "fuzz.txt");
        break;
      case 7:
        pcrb::parseEthProtocol(text, "fuzz.txt");
        break;
      default:
        for (const auto& pose : pcrb::parsePoseFile(text, "fuzz.txt").poses) {
          require(pose.T_world_body.matrix().allFinite());
        }
        break;
    }
  });
}

}  // namespace

/// So little that what goes beyond it meets run_fuzzers' -malloc_limit_mb.
extern "C" int LLVMFuzzerInitialize(int*, char***) {
  pcrb::MemoryBudget::ofProcess().setLimit(std::size_t{64} << 20);
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  PCRB_FUZZ_TARGET({reinterpret_cast<const char*>(data), size});
  return 0;
}
