#pragma once

#include <algorithm>
#include <cstddef>
#include <deque>

namespace pcrb {

/// How long a node works on a scan, as its answers to the problems so far tell. Times in s.
class NodePace {
 public:
  void add(double work) {
    works_.push_back(work);
    if (works_.size() > kRemembered) works_.pop_front();
  }

  bool isKnown() const { return !works_.empty(); }

  /// For the newest answer, 0 while nothing is known.
  double latest() const { return works_.empty() ? 0.0 : works_.back(); }

  /// For the slowest of the last answers, 0 while nothing is known. A map that is built for the
  /// first scan is forgotten in time.
  double slowest() const {
    return works_.empty() ? 0.0 : *std::max_element(works_.begin(), works_.end());
  }

  /// Whether it answers a scan when the next one comes, and so never the last one.
  bool holdsLastScan() const { return holds_last_scan_; }
  void setHoldsLastScan(bool holds) { holds_last_scan_ = holds; }

 private:
  static constexpr std::size_t kRemembered = 10;

  std::deque<double> works_;
  bool holds_last_scan_ = false;
};

}  // namespace pcrb
