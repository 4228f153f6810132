#include "server/run_console.hpp"

#include <gtest/gtest.h>

namespace pcrb {
namespace {

TEST(RunProgress, CountsOnlyThisSessionsProblemsForTheRate) {
  EXPECT_EQ(formatRunProgress(50, 100, 10, 5.0),
            "50/100 problems (50 %), 2.00 problems/s, 25 s left");
  EXPECT_EQ(formatRunProgress(50, 100, 0, 0.0), "50/100 problems (50 %)");
}

TEST(RunProgress, SaysMinutesAndHours) {
  EXPECT_EQ(formatRunProgress(1, 101, 1, 1.0),
            "1/101 problems (0 %), 1.00 problems/s, 1 min 40 s left");
  EXPECT_EQ(formatRunProgress(1, 7201, 1, 1.0),
            "1/7201 problems (0 %), 1.00 problems/s, 2 h 0 min left");
}

}  // namespace
}  // namespace pcrb
