#include "common/progress.hpp"

#include <gtest/gtest.h>

#include <sstream>

namespace pcrb_tools {
namespace {

using TimePoint = std::chrono::steady_clock::time_point;

class ProgressTest : public ::testing::Test {
 protected:
  Progress::Clock clock() {
    return [this] { return now_; };
  }
  void pass(double seconds) {
    now_ += std::chrono::duration_cast<TimePoint::duration>(std::chrono::duration<double>(seconds));
  }

  TimePoint now_{};
  std::ostringstream out_;
};

TEST_F(ProgressTest, SaysRateAndTimeLeft) {
  EXPECT_EQ(formatProgress({"apartment", "scans", 12, 0, 45, 4.0}),
            "apartment: 12/45 scans (26 %), 3.00 scans/s, 11 s left");
}

TEST_F(ProgressTest, KeptUnitsDoNotCountInTheRate) {
  EXPECT_EQ(formatProgress({"plain", "scans", 20, 10, 40, 10.0}),
            "plain: 20/40 scans (50 %), 10 kept, 1.00 scans/s, 20 s left");
}

TEST_F(ProgressTest, ShowsBytesAsMegabytesAndUnknownTotalsWithoutPercent) {
  EXPECT_EQ(formatProgress({"a.zip", "bytes", 2500000, 0, 0, 1.0}), "a.zip: 2.5 MB, 2.50 MB/s");
}

TEST_F(ProgressTest, SaysHowLongItTookAtTheEnd) {
  EXPECT_EQ(formatProgress({"x", "pairs", 7200, 0, 7200, 3661.0}),
            "x: 7200/7200 pairs (100 %), 1.97 pairs/s, 1 h 1 min 1 s");
}

TEST_F(ProgressTest, WritesALineNowAndThenWhereThereIsNoTerminal) {
  Progress progress("x", "scans", 100, out_, false, clock());
  for (int i = 0; i < 25; ++i) {
    pass(1.0);
    progress.add();
  }
  progress.finish();
  EXPECT_EQ(out_.str(),
            "x: 10/100 scans (10 %), 1.00 scans/s, 1 min 30 s left\n"
            "x: 20/100 scans (20 %), 1.00 scans/s, 1 min 20 s left\n"
            "x: 25/100 scans (25 %), 1.00 scans/s, 1 min 15 s left\n");
}

TEST_F(ProgressTest, RedrawsItsLineOnATerminalAndErasesLongerText) {
  {
    Progress progress("x", "scans", 10, out_, true, clock());
    pass(1.0);
    progress.add(9);
    pass(9.0);
    progress.add(1);
    progress.finish();
  }
  const std::string first = "x: 9/10 scans (90 %), 9.00 scans/s, 1 s left";
  const std::string second = "x: 10/10 scans (100 %), 1.00 scans/s, 10 s";
  const std::string blanks(first.size() - second.size(), ' ');
  EXPECT_EQ(out_.str(), "\r" + first + "\r" + second + blanks + "\r" + second + "\n");
}

TEST_F(ProgressTest, GoesOnCountingUnderAnotherName) {
  Progress progress("icp", "problems", 10, out_, false, clock());
  pass(5.0);
  progress.add(5);
  progress.rename("icp, apartment");
  pass(5.0);
  progress.add();
  EXPECT_EQ(out_.str(), "icp, apartment: 6/10 problems (60 %), 0.60 problems/s, 7 s left\n");
}

TEST_F(ProgressTest, NotesDoNotMixWithTheLineBeingRedrawn) {
  Progress progress("x", "scans", 0, out_, true, clock());
  pass(1.0);
  progress.add();
  progress.note("dropped 3 scans");
  const std::string line = "x: 1 scans, 1.00 scans/s";
  EXPECT_EQ(out_.str(), "\r" + line + "\r" + std::string(line.size(), ' ') + "\rdropped 3 scans\n");
}

}  // namespace
}  // namespace pcrb_tools
