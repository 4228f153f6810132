#include "pcrb_core/datasets/stamp.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "pcrb_core/error.hpp"

namespace pcrb {
namespace {

TEST(Stamp, TextOfSecondsIsReadExactly) {
  EXPECT_EQ(parseStamp("1311878220.377686160"), 1311878220377686160);
  EXPECT_EQ(parseStamp("1311868163.8697"), 1311868163869700000);
  EXPECT_EQ(parseStamp("1311868163"), 1311868163000000000);
  EXPECT_EQ(parseStamp("0.000000001"), 1);
  EXPECT_EQ(parseStamp("1.5000000000000"), 1500000000);
}

TEST(Stamp, NameOfACloudHasNineDecimalsAndIsNotRounded) {
  // Through a double this would be …377686272.
  EXPECT_EQ(formatStamp(1311878220377686160), "1311878220.377686160");
  EXPECT_EQ(formatStamp(1311878220000000007), "1311878220.000000007");
  EXPECT_EQ(formatStamp(1000000000), "1.000000000");
}

TEST(Stamp, RejectsWhatIsNoTimeOrWouldBeRounded) {
  for (const char* text : {"", ".", ".5", "-1.5", "+1.5", "1e9", "1.5e3", "1.2.3", "1,5", " 1",
                           "1.0000000001", "9223372036.9", "99999999999999999999"}) {
    EXPECT_FALSE(parseStamp(text)) << text;
  }
}

TEST(Stamp, DurationsOfTheCommandLineAreChecked) {
  EXPECT_EQ(toStamp(0.1), 100000000);
  EXPECT_THROW(toStamp(-1.0), InvalidParameter);
  EXPECT_THROW(toStamp(1e12), InvalidParameter);
  EXPECT_THROW(toStamp(std::numeric_limits<double>::quiet_NaN()), InvalidParameter);
}

}  // namespace
}  // namespace pcrb
