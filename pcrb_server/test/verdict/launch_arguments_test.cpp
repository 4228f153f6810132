#include "verdict/launch_arguments.hpp"

#include <gtest/gtest.h>

namespace pcrb {
namespace {

using Names = std::vector<std::string>;

Names argumentsOf(const std::string& words) {
  std::string line = words;
  for (char& c : line) {
    if (c == ' ') c = '\0';
  }
  return launchArguments(line, "evaluate.test");
}

TEST(LaunchArguments, AreTheNamesOfTheFilesCommandLine) {
  EXPECT_EQ(argumentsOf("python3 rostest pcrb_launch evaluate.test root:=/a max_meidan:=1"),
            (Names{"root", "max_meidan"}));
  EXPECT_EQ(argumentsOf("rostest /a/b/evaluate.test run:= __log:=x"), (Names{"run"}));
}

TEST(LaunchArguments, OfAnotherFileAreNobodysBusiness) {
  EXPECT_EQ(argumentsOf("rostest mine mine.test max_meidan:=1"), Names());
  EXPECT_EQ(argumentsOf("rostest mine not_evaluate.test a:=1"), Names());
  EXPECT_EQ(argumentsOf(""), Names());
}

}  // namespace
}  // namespace pcrb
