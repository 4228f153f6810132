#include "common/progress.hpp"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <iostream>
#include <sstream>
#include <utility>

namespace pcrb_tools {
namespace {

constexpr std::chrono::milliseconds kRedraw{100};
constexpr std::chrono::seconds kLogLine{10};
constexpr double kMegabyte = 1e6;

bool isBytes(const std::string& unit) { return unit == "bytes"; }

std::string amount(double units, const std::string& unit) {
  std::ostringstream text;
  text << std::fixed << std::setprecision(isBytes(unit) ? 1 : 0)
       << (isBytes(unit) ? units / kMegabyte : units);
  return text.str();
}

std::string shownUnit(const std::string& unit) { return isBytes(unit) ? "MB" : unit; }

std::string rate(double units_per_s, const std::string& unit) {
  const double value = isBytes(unit) ? units_per_s / kMegabyte : units_per_s;
  std::ostringstream text;
  text << std::fixed << std::setprecision(value < 10.0 ? 2 : 0) << value << ' ' << shownUnit(unit)
       << "/s";
  return text.str();
}

std::string duration(double seconds) {
  const auto whole = static_cast<long long>(std::ceil(seconds));
  std::ostringstream text;
  if (whole >= 3600) text << whole / 3600 << " h ";
  if (whole >= 60) text << whole / 60 % 60 << " min ";
  text << whole % 60 << " s";
  return text.str();
}

}  // namespace

std::string formatProgress(const ProgressState& state) {
  std::ostringstream line;
  line << state.what << ": " << amount(static_cast<double>(state.done), state.unit);
  if (state.total > 0) line << '/' << amount(static_cast<double>(state.total), state.unit);
  line << ' ' << shownUnit(state.unit);
  if (state.total > 0) line << " (" << 100 * state.done / state.total << " %)";
  if (state.kept > 0)
    line << ", " << amount(static_cast<double>(state.kept), state.unit) << " kept";
  const double made = static_cast<double>(state.done - std::min(state.kept, state.done));
  if (made > 0 && state.elapsed_s > 0) {
    const double per_second = made / state.elapsed_s;
    line << ", " << rate(per_second, state.unit);
    if (state.total > state.done) {
      line << ", " << duration(static_cast<double>(state.total - state.done) / per_second)
           << " left";
    }
  }
  if (state.total > 0 && state.done == state.total) line << ", " << duration(state.elapsed_s);
  return line.str();
}

Progress::Progress(std::string what, std::string unit, std::size_t total)
    : Progress(std::move(what), std::move(unit), total, std::cerr, isatty(STDERR_FILENO) == 1,
               std::chrono::steady_clock::now) {}

Progress::Progress(std::string what, std::string unit, std::size_t total, std::ostream& out,
                   bool is_terminal, Clock clock)
    : state_{std::move(what), std::move(unit), 0, 0, total, 0.0},
      out_(out),
      is_terminal_(is_terminal),
      clock_(std::move(clock)),
      start_(clock_()),
      shown_(start_) {}

Progress::~Progress() {
  if (is_terminal_ && drawn_width_ > 0 && !finished_) out_ << std::endl;
}

void Progress::add(std::size_t units) {
  const std::lock_guard<std::mutex> lock(mutex_);
  state_.done += units;
  show(false);
}

void Progress::keep(std::size_t units) {
  const std::lock_guard<std::mutex> lock(mutex_);
  state_.done += units;
  state_.kept += units;
  show(false);
}

void Progress::set(std::size_t done, std::size_t total) {
  const std::lock_guard<std::mutex> lock(mutex_);
  state_.done = done;
  state_.total = total;
  show(false);
}

void Progress::rename(const std::string& what) {
  const std::lock_guard<std::mutex> lock(mutex_);
  state_.what = what;
}

void Progress::note(const std::string& line) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (is_terminal_ && drawn_width_ > 0) {
    out_ << '\r' << std::string(drawn_width_, ' ') << '\r';
    drawn_width_ = 0;
  }
  out_ << line << std::endl;
}

void Progress::finish() {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (finished_) return;
  show(true);
  finished_ = true;
}

void Progress::show(bool last) {
  const auto now = clock_();
  const auto interval = is_terminal_
                            ? std::chrono::duration_cast<std::chrono::milliseconds>(kRedraw)
                            : std::chrono::duration_cast<std::chrono::milliseconds>(kLogLine);
  if (!last && now - shown_ < interval) return;
  shown_ = now;
  state_.elapsed_s = std::chrono::duration<double>(now - start_).count();
  const std::string line = formatProgress(state_);
  if (!is_terminal_) {
    out_ << line << std::endl;
    return;
  }
  const std::size_t blanks = drawn_width_ > line.size() ? drawn_width_ - line.size() : 0;
  out_ << '\r' << line << std::string(blanks, ' ') << std::flush;
  drawn_width_ = line.size();
  if (last) out_ << std::endl;
}

}  // namespace pcrb_tools
