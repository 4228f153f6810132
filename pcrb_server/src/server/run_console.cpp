#include "server/run_console.hpp"

#include <cmath>
#include <iomanip>
#include <iostream>
#include <sstream>

namespace pcrb {

namespace {

constexpr auto kShowPeriod = std::chrono::seconds(5);

std::string formatDuration(double seconds) {
  const auto whole = static_cast<long long>(std::ceil(seconds));
  std::ostringstream text;
  if (whole >= 3600) text << whole / 3600 << " h ";
  if (whole >= 60) text << whole % 3600 / 60 << " min ";
  if (whole < 3600) text << whole % 60 << " s ";
  text << "left";
  return text.str();
}

/// The texts of a list, separated by blanks.
template <typename List, typename Format>
std::string listOf(const List& list, const Format& format) {
  std::string text;
  for (const auto& element : list) text += (text.empty() ? "" : " ") + std::string(format(element));
  return text;
}

}  // namespace

std::string describe(const ServerParameters& parameters) {
  const ProblemSelection& selection = parameters.configuration.selection;
  const std::string subset = selection.subset > 0 ? std::to_string(selection.subset) : "all";
  return "results: " + parameters.run + "\nproblems: " + selection.root + ", sequences " +
         listOf(selection.sequences, [](const std::string& word) { return word; }) + ", kind " +
         listOf(selection.kinds, [](Kind kind) { return toString(kind); }) + ", subset " + subset +
         ", shard " + toString(selection.shard);
}

std::string describeEnd(const ServerParameters& parameters, const std::string& table,
                        std::size_t done, std::size_t total) {
  std::string text = '\n' + table + "results: " + parameters.run + '\n';
  if (done == total) return text;
  return text + std::to_string(done) + " of " + std::to_string(total) +
         " problems have a result; start again with the same ~run to go on\n";
}

std::string describeDoubts(std::uint64_t foreign_replies, std::size_t skipped) {
  std::string text;
  if (foreign_replies > 0) {
    text += std::to_string(foreign_replies) +
            " replies were rejected: they came from nodes that had not called `ready`\n";
  }
  if (skipped > 0) {
    text += std::to_string(skipped) +
            " problems were skipped on request, which fails the run (~allow_skipped allows it)\n";
  }
  return text;
}

std::string formatRunProgress(std::size_t done, std::size_t total, std::size_t done_now,
                              double elapsed_s) {
  std::ostringstream text;
  text << done << '/' << total << " problems (" << (total == 0 ? 100 : 100 * done / total) << " %)";
  if (done_now == 0 || elapsed_s <= 0.0) return text.str();
  const double rate = static_cast<double>(done_now) / elapsed_s;
  text << std::fixed << std::setprecision(rate < 10.0 ? 2 : 0) << ", " << rate << " problems/s, "
       << formatDuration(static_cast<double>(total - done) / rate);
  return text.str();
}

RunProgress::RunProgress(std::size_t done, std::size_t total)
    : before_(done), done_(done), total_(total), start_(Clock::now()), shown_(start_) {
  std::cout << formatRunProgress(done, total, 0, 0.0) << std::endl;
}

void RunProgress::add() {
  ++done_;
  const auto now = Clock::now();
  if (now - shown_ < kShowPeriod && done_ < total_) return;
  shown_ = now;
  const double elapsed = std::chrono::duration<double>(now - start_).count();
  std::cout << formatRunProgress(done_, total_, done_ - before_, elapsed) << std::endl;
}

}  // namespace pcrb
