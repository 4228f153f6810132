#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <mutex>
#include <ostream>
#include <string>

namespace pcrb_tools {

/// How far a tool is. `formatProgress` turns it into the line that a person sees.
struct ProgressState {
  std::string what;        ///< e.g. `apartment`
  std::string unit;        ///< plural, e.g. `scans`
  std::size_t done = 0;    ///< units done in all
  std::size_t kept = 0;    ///< of these, units that were there already and took no time
  std::size_t total = 0;   ///< 0 = unknown
  double elapsed_s = 0.0;  ///< since the start
};

/// E.g. `apartment: 12/45 scans (27 %), 3.1 scans/s, 11 s left`. Bytes are shown as MB.
std::string formatProgress(const ProgressState& state);

/// Shows progress: on a terminal one line that is redrawn, elsewhere (log files, roslaunch) a line
/// every ten seconds and a last one. Can be called from several threads.
class Progress {
 public:
  using Clock = std::function<std::chrono::steady_clock::time_point()>;

  /// On standard error; `total` 0 = unknown.
  Progress(std::string what, std::string unit, std::size_t total);

  /// With an output and a clock of the caller's, for tests.
  Progress(std::string what, std::string unit, std::size_t total, std::ostream& out,
           bool is_terminal, Clock clock);

  /// Ends the line that is being redrawn; nothing is said of work that was not done.
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Units that were done now.
  void add(std::size_t units = 1);

  /// Units that an earlier run had left complete: they count as done but not in the rate.
  void keep(std::size_t units);

  /// Sets how many units are done in all, kept ones included, for callers who are told totals.
  void set(std::size_t done, std::size_t total);

  /// Says from now on that another thing is being done; counts and time go on.
  void rename(const std::string& what);

  /// Shows a line of text without garbling the one that is being redrawn.
  void note(const std::string& line);

  /// Shows the final state.
  void finish();

 private:
  void show(bool last);

  std::mutex mutex_;
  ProgressState state_;
  std::ostream& out_;
  bool is_terminal_;
  Clock clock_;
  std::chrono::steady_clock::time_point start_;
  std::chrono::steady_clock::time_point shown_;
  std::size_t drawn_width_ = 0;
  bool finished_ = false;
};

}  // namespace pcrb_tools
