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

TEST(Timestamp, IsAnyDecimalNumberOfSecondsToTheNearestNanosecond) {
  EXPECT_EQ(parseTimestamp("1311868163.8697"), 1311868163869700000);
  EXPECT_EQ(parseTimestamp("1.3e+09"), 1300000000000000000);
  EXPECT_EQ(parseTimestamp("1.311878220377686160e+09"), 1311878220377686160);  // numpy.savetxt
  EXPECT_EQ(parseTimestamp("1.31187822037768616E9"), 1311878220377686160);
  EXPECT_EQ(parseTimestamp("1311878220.377686160499"), 1311878220377686160);  // twelve decimals
  EXPECT_EQ(parseTimestamp("1311878220.377686160500"), 1311878220377686161);
  EXPECT_EQ(parseTimestamp("1.9999999999"), 2000000000);
  EXPECT_EQ(parseTimestamp("15e-10"), 2);
  EXPECT_EQ(parseTimestamp("4e-10"), 0);
  EXPECT_EQ(parseTimestamp("+1.5"), 1500000000);
  EXPECT_EQ(parseTimestamp(".5"), 500000000);
  EXPECT_EQ(parseTimestamp("5."), 5000000000);
  EXPECT_EQ(parseTimestamp("0.000000000000000000000000e+00"), 0);
  EXPECT_EQ(parseTimestamp("00012"), 12000000000);
}

TEST(Timestamp, RejectsWhatIsNoTime) {
  for (const char* text :
       {"", ".", "e5", "1e", "1e+", "1e+-5", "-1", "nan", "inf", "1.2.3", "1,5", " 1", "1 ", "0x10",
        "1e10", "99999999999999999999", "1e1001", "1e99999999999999999999", "1_000"}) {
    EXPECT_FALSE(parseTimestamp(text)) << text;
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
