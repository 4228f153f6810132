#include "pcrb_core/datasets/planetary.hpp"

#include "datasets/log_rows.hpp"
#include "pcrb_core/error.hpp"
#include "pcrb_core/io/number.hpp"

namespace pcrb {
namespace {

/// Whether a line is exactly three numbers; faster than parseNumbers on a hundred thousand lines.
///
/// @param text_end  of the text that the line is in: scanning is faster where it may look ahead,
///                  and no number goes beyond its line.
bool parsePoint(std::string_view line, const char* text_end, Eigen::Vector3d& point) {
  const char* at = line.data();
  const char* const end = at + line.size();
  for (int axis = 0; axis < 3; ++axis) {
    const char* const before = at;
    at = skipBlanks(at, end);
    if (axis > 0 && at == before) return false;
    at = scanDouble(at, text_end, point[axis]);
    if (at == nullptr) return false;
  }
  return skipBlanks(at, end) == end;
}

}  // namespace

SensorScan parsePlanetaryScan(std::string_view text, const std::string& name,
                              double max_malformed) {
  SensorScan scan;
  LineReader reader(text, name);
  std::string_view line;
  Eigen::Vector3d point;
  const char* const text_end = text.data() + text.size();
  while (reader.next(line)) {
    if (scan.points.empty()) scan.points.reserve(reader.rest().size() / (line.size() + 1) + 1);
    if (parsePoint(line, text_end, point)) {
      scan.add(point, OriginPoints::kKeep);
    } else if (!trimmed(line).empty()) {
      ++scan.counts.read;
      ++scan.counts.malformed;
    }
  }
  if (scan.points.empty()) {
    throw InvalidFile(name, 0, "no line with a point among " + std::to_string(reader.lineNumber()),
                      "lines 'x y z'");
  }
  const PointCounts& counts = scan.counts;
  if (counts.malformed > kFewMalformedLines &&
      static_cast<double>(counts.malformed) > max_malformed * static_cast<double>(counts.read)) {
    throw InvalidFile(name, 0,
                      std::to_string(counts.malformed) + " of " + std::to_string(counts.read) +
                          " lines that are no point",
                      "'x y z' in all but " + formatShortest(100.0 * max_malformed) +
                          " % (--max-malformed allows more)");
  }
  return scan;
}

Transform parsePlanetaryPose(std::string_view text, const std::string& name) {
  const std::string expected = "4 rows of 4 numbers";
  LineReader reader(text, name);
  std::string_view line;
  std::vector<double> numbers;
  while (reader.nextRow(line)) {
    if (numbers.size() == 16) reader.fail("a fifth row", expected);
    const auto row = requireNumbers(reader, line, Separator::kBlanks, 4, expected);
    numbers.insert(numbers.end(), row.begin(), row.end());
  }
  if (numbers.size() != 16) {
    throw InvalidFile(name, 0, std::to_string(numbers.size() / 4) + " rows", expected);
  }
  return asViewpoint(requireLogPose4x4(reader, numbers.data()));
}

}  // namespace pcrb
