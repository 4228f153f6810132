#include "pcrb_server/parameter_table.hpp"

#include <gtest/gtest.h>
#include <stdlib.h>

#include <sstream>

#include "pcrb_core/error.hpp"

namespace pcrb {
namespace {

class ExpandVariablesTest : public testing::Test {
 protected:
  void SetUp() override {
    setenv("PCRB_TEST", "a  folder*", 1);
    unsetenv("PCRB_TEST_NONE");
  }
  void TearDown() override { unsetenv("PCRB_TEST"); }
};

TEST_F(ExpandVariablesTest, PutsValuesInAsTheyAre) {
  EXPECT_EQ(expandVariables("~name", "map=$PCRB_TEST/map.pcd"), "map=a  folder*/map.pcd");
  EXPECT_EQ(expandVariables("~name", "${PCRB_TEST:-/tmp}x"), "a  folder*x");
  EXPECT_EQ(expandVariables("~name", "${PCRB_TEST_NONE:-/tmp}/x"), "/tmp/x");
}

TEST_F(ExpandVariablesTest, LeavesEverythingElseAsItIs) {
  for (const char* text : {"", "~/a * | ; & (b) {c} 'd' \"e\" \\", "a=b"}) {
    EXPECT_EQ(expandVariables("~name", text), text);
  }
  EXPECT_EQ(expandVariables("~name", "~/* 'd' ${PCRB_TEST_NONE:-}"), "~/* 'd' ");
}

TEST_F(ExpandVariablesTest, RefusesWhatIsNotSetAndCommands) {
  for (const char* text :
       {"$PCRB_TEST_NONE", "$(env PCRB_TEST)", "${", "${PCRB_TEST:?}", "a$", "$$"}) {
    EXPECT_THROW(expandVariables("~name", text), InvalidParameter) << text;
  }
}

const ParameterTable kTable{
    {"", "", "", "Times"},
    {"rate", "2", "Hz", "rate of the scans"},
    {"order", "worst", "worst|best|first", "order of the scenes"},
    {"plugin", "", "", "library to load"},
    {"root", kRequired, "",
     "a folder whose help is so long that it does not fit into one line beside its name and so is "
     "continued in the next one"}};

TEST(ParameterTable, HelpHasNameDefaultUnitAndWords) {
  const std::string text = formatParameters(kTable);
  EXPECT_EQ(text.substr(0, text.find("  root")),
            "Times:\n"
            "  rate (2 Hz)                       rate of the scans\n"
            "  order (worst)                     order of the scenes: worst, best or first\n"
            "  plugin                            library to load\n");
}

TEST(ParameterTable, HelpFitsIntoAHundredColumns) {
  std::istringstream lines(formatParameters(kTable));
  int count = 0;
  for (std::string line; std::getline(lines, line); ++count) EXPECT_LE(line.size(), 100u) << line;
  EXPECT_EQ(count, 6);
}

TEST(ParameterTable, FindsAnEntryByItsNameAndNoHeading) {
  ASSERT_NE(findParameter(kTable, "rate"), nullptr);
  EXPECT_EQ(findParameter(kTable, "rate")->fallback, "2");
  EXPECT_EQ(findParameter(kTable, ""), nullptr);
  EXPECT_EQ(findParameter(kTable, "rates"), nullptr);
}

TEST(ParameterTable, QuotesKeepAnArgumentTogetherAndCommasAreNothingSpecial) {
  EXPECT_EQ(splitArguments("args", R"( pose=1,2,3 "map=/a b/m.pcd" name='' x="it's" )"),
            (std::vector<std::string>{"pose=1,2,3", "map=/a b/m.pcd", "name=", "x=it's"}));
  EXPECT_TRUE(splitArguments("args", " ").empty());
  EXPECT_THROW(splitArguments("args", "map='/a b"), InvalidParameter);
}

TEST(ParameterTable, SplitsWordsAtCommasAndBlanks) {
  EXPECT_EQ(splitWords(" a,b\tc\n"), (std::vector<std::string>{"a", "b", "c"}));
  EXPECT_TRUE(splitWords(" , ").empty());
}

TEST(RelativePathMistake, SaysWhatToWriteInstead) {
  EXPECT_EQ(relativePathMistake("run", "/runs/a"), "");
  EXPECT_NE(relativePathMistake("run", "runs/a").find("run:=$PWD/runs/a"), std::string::npos);
  EXPECT_NE(relativePathMistake("run", "~/runs/a").find("run:=$HOME/runs/a"), std::string::npos);
}

}  // namespace
}  // namespace pcrb
