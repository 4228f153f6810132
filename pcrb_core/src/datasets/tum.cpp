#include "pcrb_core/datasets/tum.hpp"

#include <cmath>

#include "pcrb_core/error.hpp"
#include "pcrb_core/io/number.hpp"
#include "pcrb_core/io/text.hpp"

namespace pcrb {
namespace {

/// The word at the start of a line, which is taken away.
std::string_view takeWord(std::string_view& line) {
  line = trimmed(line);
  const std::string_view word = line.substr(0, line.find_first_of(" \t"));
  line.remove_prefix(word.size());
  return word;
}

Stamp requireStamp(const LineReader& reader, std::string_view word) {
  const auto stamp = parseTimestamp(word);
  if (!stamp) reader.fail(inQuotes(word), "a timestamp in seconds");
  return *stamp;
}

bool staysBelow(std::string_view path) {
  if (path.empty() || path.front() == '/' || path.find('\\') != std::string_view::npos) {
    return false;
  }
  while (!path.empty()) {
    const std::size_t slash = path.find('/');
    if (path.substr(0, slash) == "..") return false;
    path.remove_prefix(slash == std::string_view::npos ? path.size() : slash + 1);
  }
  return true;
}

}  // namespace

std::vector<TumImage> parseTumImageList(std::string_view text, const std::string& name) {
  std::vector<TumImage> images;
  LineReader reader(text, name);
  std::string_view line;
  while (reader.nextDataRow(line)) {
    const Stamp stamp = requireStamp(reader, takeWord(line));
    const std::string_view path = takeWord(line);
    if (!trimmed(line).empty() || !staysBelow(path)) {
      reader.fail(inQuotes(std::string(path) + std::string(line)),
                  "a path below the list's folder, without blanks");
    }
    images.push_back({stamp, std::string(path)});
  }
  if (images.empty()) throw InvalidFile(name, 0, "no image", "rows 'timestamp path'");
  return images;
}

RateLimiter::RateLimiter(double max_rate) {
  if (!(max_rate >= 0.0) || !std::isfinite(max_rate)) {
    throw InvalidParameter("found a maximal rate of " + formatShortest(max_rate) +
                           " Hz, expected a positive one, or 0 for all");
  }
  if (max_rate > 0.0) period_ = toStamp(1.0 / max_rate);
}

bool RateLimiter::keep(Stamp stamp) {
  if (period_ == 0) return true;
  // After a gap the schedule starts anew: it must not catch up by keeping everything. When a log is
  // played again, too: it must not wait until it is where it was.
  const bool goes_back = stamp < due_ - 2 * period_;
  const bool restart = first_ || goes_back || stamp >= due_ + period_;
  if (!restart && stamp < due_ - period_ / 10) return false;
  due_ = (restart ? stamp : due_) + period_;
  first_ = false;
  return true;
}

std::string tumSequenceName(std::string_view log_name) {
  constexpr std::string_view kPrefix = "rgbd_dataset_freiburg";
  std::string_view name = log_name;
  if (name.substr(0, kPrefix.size()) != kPrefix) return std::string(log_name);
  const std::size_t underscore = name.find('_', kPrefix.size());
  if (underscore == std::string_view::npos) return std::string(log_name);
  name.remove_prefix(underscore + 1);
  return std::string(name.substr(0, name.find('-')));
}

}  // namespace pcrb
