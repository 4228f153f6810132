#include "pcrb_core/datasets/stamp_mismatch.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "pcrb_core/datasets/kaist.hpp"
#include "pcrb_core/io/number.hpp"

namespace pcrb {
namespace {

double inSeconds(Stamp stamp) { return static_cast<double>(stamp) / static_cast<double>(kSecond); }

std::string rangeText(Stamp first, Stamp last) {
  return formatFixed(inSeconds(first), 3) + " to " + formatFixed(inSeconds(last), 3) + " s";
}

/// Whether one is about the other times a factor.
bool isMultiple(double large, double small, double factor) {
  return small > 0.0 && std::abs(large / (small * factor) - 1.0) < 0.5;
}

std::string guess(double scan, double pose, double scans_last, double difference) {
  constexpr double kFactors[] = {1e3, 1e6, 1e9};
  constexpr const char* kUnits[] = {"milliseconds", "microseconds", "nanoseconds"};
  constexpr double k1973 = 1e8;  // s since 1970
  for (int i = 0; i != 3; ++i) {
    const bool are_scans_less = isMultiple(pose, scan, kFactors[i]);
    if (!are_scans_less && !isMultiple(scan, pose, kFactors[i])) continue;
    return std::string("are the ") + (are_scans_less ? "scans'" : "poses'") +
           " timestamps seconds that were taken as " + kUnits[i] + "?";
  }
  if (pose < k1973 && scan > k1973) return "are the poses' timestamps indices, or since the start?";
  if (scan < k1973 && pose > k1973 && std::floor(scans_last) == scans_last) {
    return "are the scans' timestamps indices?";
  }
  return "do the clocks differ? (a constant " + formatFixed(difference, 3) +
         " s added to the poses' timestamps would make them meet)";
}

}  // namespace

std::string describeMismatch(const std::vector<Stamp>& scans, const std::vector<Stamp>& poses) {
  const auto [first, last] = std::minmax_element(scans.begin(), scans.end());
  Stamp nearest = std::numeric_limits<Stamp>::max();
  for (const Stamp scan : scans) {
    nearest = std::min(nearest, std::abs(scan - closestStamp(poses, scan)));
  }
  const double start_difference = inSeconds(*first) - inSeconds(poses.front());
  const bool do_overlap = *first <= poses.back() && *last >= poses.front();
  return "scans from " + rangeText(*first, *last) + ", poses from " +
         rangeText(poses.front(), poses.back()) + "; the nearest pose is " +
         formatFixed(inSeconds(nearest), 6) + " s from a scan: " +
         (do_overlap ? "are the poses too far apart? (a larger limit of their gap)"
                     : guess(inSeconds(*first), inSeconds(poses.front()), inSeconds(*last),
                             start_difference));
}

}  // namespace pcrb
