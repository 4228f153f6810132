#include "datasets/record_length.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <vector>

#include "datasets/records.hpp"
#include "pcrb_core/error.hpp"

namespace pcrb {
namespace {

constexpr std::array<std::size_t, 6> kUsualFields = {3, 4, 5, 6, 7, 8};

/// Records of another length make numbers that no lidar gives.
void requirePossible(const SensorScan& scan, std::size_t fields, const std::string& name) {
  constexpr double kReach = 1000.0;  // m
  constexpr std::size_t kFew = 10;
  const auto impossible = static_cast<std::size_t>(std::count_if(
      scan.points.begin(), scan.points.end(),
      [](const Eigen::Vector3d& point) { return point.lpNorm<Eigen::Infinity>() > kReach; }));
  const std::size_t wrong = impossible + scan.counts.non_finite;
  if (impossible == 0 || wrong <= std::max(kFew, scan.counts.read / 100)) return;
  throw InvalidFile(name, 0,
                    std::to_string(wrong) + " of " + std::to_string(scan.counts.read) +
                        " records with a coordinate beyond 1 km or that is not finite",
                    "records of " + std::to_string(fields) +
                        " float32 numbers (x y z first): are these longer or shorter? "
                        "(--bin-fields)");
}

/// The numbers of a file; 0 in place of those that are not finite.
std::vector<float> numbersOf(std::string_view bytes) {
  std::vector<float> numbers;
  numbers.reserve(bytes.size() / sizeof(float));
  for (std::size_t at = 0; at != bytes.size(); at += sizeof(float)) {
    const double number = loadNumber(bytes.data() + at, RecordField{}, false);
    numbers.push_back(std::isfinite(number) ? static_cast<float>(number) : 0.0F);
  }
  return numbers;
}

/// Whether a number is whole in all records, if they have so many: a ring, a line, an intensity.
bool hasWholeNumber(const std::vector<float>& numbers, std::size_t fields) {
  for (std::size_t column = 0; column != fields; ++column) {
    std::size_t at = column;
    while (at < numbers.size() && numbers[at] == std::floor(numbers[at])) at += fields;
    if (at >= numbers.size()) return true;
  }
  return false;
}

/// How much the columns' means differ, if records have so many numbers: the F ratio of an analysis
/// of variance, which is about 1 where each column is a mixture of all, and grows with the records
/// where each is of one kind.
///
/// @param kind  of a number, what is looked at
template <typename Kind>
double contrast(const std::vector<float>& numbers, std::size_t fields, Kind kind) {
  const auto size = static_cast<double>(numbers.size());
  const auto columns = static_cast<double>(fields);
  const double records = size / columns;
  std::vector<double> means(fields, 0.0);
  double squares = 0.0;
  for (std::size_t i = 0; i != numbers.size(); ++i) {
    const double number = kind(static_cast<double>(numbers[i]));
    means[i % fields] += number / records;
    squares += number * number;
  }
  const double mean = std::accumulate(means.begin(), means.end(), 0.0) / columns;
  double between = 0.0;
  double of_means = 0.0;
  for (const double of_column : means) {
    between += records * (of_column - mean) * (of_column - mean);
    of_means += records * of_column * of_column;
  }
  const double within = (squares - of_means) / (size - columns);
  return within > 0.0 ? between / (columns - 1.0) / within : 0.0;
}

/// Of the numbers or of their sizes: x and y may have the same mean as z, in a wider spread.
double contrast(const std::vector<float>& numbers, std::size_t fields) {
  return std::max(contrast(numbers, fields, [](double number) { return number; }),
                  contrast(numbers, fields, [](double number) { return std::abs(number); }));
}

[[noreturn]] void refuseLength(const std::string& what, std::size_t fields, std::size_t other,
                               const std::string& name) {
  throw InvalidFile(name, 0,
                    what + " if records have " + std::to_string(other) +
                        " float32 numbers, and none if they have " + std::to_string(fields),
                    "records of " + std::to_string(fields) +
                        " numbers (x y z first): try --bin-fields " + std::to_string(other));
}

void requireNoOtherLength(const std::vector<float>& numbers, std::size_t fields,
                          const std::string& name) {
  constexpr double kMixed = 5.0;
  constexpr double kDifferent = 100.0;
  const bool has_whole = hasWholeNumber(numbers, fields);
  const bool is_mixed = contrast(numbers, fields) < kMixed;
  for (const std::size_t other : kUsualFields) {
    if (other == fields || numbers.size() % other != 0) continue;
    if (!has_whole && hasWholeNumber(numbers, other)) {
      refuseLength("a column of whole numbers, as of rings,", fields, other, name);
    }
    // Every second record may be another half of the sensor's beams.
    const bool is_multiple = other % fields == 0;
    if (is_mixed && !is_multiple && contrast(numbers, other) > kDifferent) {
      refuseLength("columns that differ", fields, other, name);
    }
  }
}

}  // namespace

void requireLikelyLength(std::string_view bytes, std::size_t fields, const SensorScan& scan,
                         const std::string& name) {
  constexpr std::size_t kFewBytes = 1000;
  requirePossible(scan, fields, name);
  if (bytes.size() < kFewBytes) return;
  requireNoOtherLength(numbersOf(bytes), fields, name);
}

}  // namespace pcrb
