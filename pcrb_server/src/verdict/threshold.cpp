#include "verdict/threshold.hpp"

#include <cmath>

#include "pcrb_core/error.hpp"
#include "pcrb_core/io/number.hpp"

namespace pcrb {

namespace {

/// What a value may be called for: most particular first.
std::vector<std::string> namesOf(const pcrb_msgs::SequenceSummary& row) {
  return {row.name + ":" + row.kind, row.name, ""};
}

void checkOne(const char* what, double found, bool is_kept, const char* comparison,
              const char* parameter, double expected, std::vector<std::string>& list) {
  if (is_kept) return;
  list.push_back(std::string(what) + " is " + formatShortest(found) + ", expected " + comparison +
                 " " + formatShortest(expected) + " (" + parameter + ")");
}

}  // namespace

Threshold::Threshold(const std::string& name, const std::vector<std::string>& words, double max) {
  for (const auto& word : words) {
    const std::size_t equals = word.find('=');
    const bool is_named = equals != std::string::npos;
    const std::string key = is_named ? word.substr(0, equals) : "";
    const auto value = parseDouble(is_named ? word.substr(equals + 1) : word);
    if (!value || !(*value >= 0.0 && *value <= max) || (is_named && key.empty())) {
      throw InvalidParameter("~" + name + ": found `" + word + "`, expected VALUE, SEQUENCE=VALUE" +
                             " or SEQUENCE:KIND=VALUE with a number from 0 to " +
                             formatShortest(max));
    }
    if (!values_.emplace(key, *value).second) {
      throw InvalidParameter("~" + name + ": found `" + word + "`, expected one value for " +
                             (key.empty() ? "every sequence" : key));
    }
  }
}

std::optional<double> Threshold::of(const pcrb_msgs::SequenceSummary& row) const {
  for (const auto& name : namesOf(row)) {
    const auto found = values_.find(name);
    if (found != values_.end()) return found->second;
  }
  return std::nullopt;
}

std::vector<std::string> Threshold::unusedNames(
    const std::vector<pcrb_msgs::SequenceSummary>& rows) const {
  auto unused = values_;
  unused.erase("");
  for (const auto& row : rows) {
    for (const auto& name : namesOf(row)) unused.erase(name);
  }
  std::vector<std::string> names;
  for (const auto& [name, value] : unused) names.push_back(name);
  return names;
}

double repliedFraction(const pcrb_msgs::SequenceSummary& row) {
  return row.count == 0 ? std::nan("") : static_cast<double>(row.replied) / row.count;
}

std::vector<std::string> breaches(const pcrb_msgs::SequenceSummary& row,
                                  const Thresholds& thresholds) {
  std::vector<std::string> list;
  if (const auto limit = thresholds.max_median.of(row)) {
    checkOne("median", row.median, row.median <= *limit, "at most", "max_median", *limit, list);
  }
  if (const auto limit = thresholds.max_q95.of(row)) {
    checkOne("q95", row.q95, row.q95 <= *limit, "at most", "max_q95", *limit, list);
  }
  if (const auto limit = thresholds.min_replied.of(row)) {
    const double fraction = repliedFraction(row);
    checkOne("replied fraction", fraction, fraction >= *limit, "at least", "min_replied", *limit,
             list);
  }
  return list;
}

}  // namespace pcrb
