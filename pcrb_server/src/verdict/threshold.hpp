#pragma once

#include <pcrb_msgs/SequenceSummary.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace pcrb {

/// What a number of a run's summary is held against: one value for every row, and others for some.
class Threshold {
 public:
  /// No value for any row.
  Threshold() = default;

  /// @param name   of the parameter, for messages.
  /// @param words  `0.1`: every row, the total included, but for those that are named; `hall=0.5`:
  ///               that row; `hall:global=0.5`: that row of this kind, before `hall=`.
  /// @param max    the largest value allowed; the least is 0.
  /// @throws InvalidParameter  for a word that is none of these, or a second value for the same.
  Threshold(const std::string& name, const std::vector<std::string>& words, double max);

  /// The value for a row, if there is one.
  std::optional<double> of(const pcrb_msgs::SequenceSummary& row) const;

  /// Names that are no row's: values that would never be looked at.
  std::vector<std::string> unusedNames(const std::vector<pcrb_msgs::SequenceSummary>& rows) const;

 private:
  std::map<std::string, double> values_;  ///< by name; empty = every row
};

/// The thresholds of `evaluation_test`.
struct Thresholds {
  Threshold max_median;
  Threshold max_q95;
  Threshold min_replied;  ///< fraction of a row's problems that ended with a valid reply
};

/// Every threshold that a row does not keep, a sentence each with what was found and expected.
/// A number that is not finite keeps none.
std::vector<std::string> breaches(const pcrb_msgs::SequenceSummary& row,
                                  const Thresholds& thresholds);

/// Fraction of a row's problems that ended with a valid reply; NaN where there are none.
double repliedFraction(const pcrb_msgs::SequenceSummary& row);

}  // namespace pcrb
