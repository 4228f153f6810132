#include "expand_variables.hpp"

#include <gtest/gtest.h>
#include <stdlib.h>

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

}  // namespace
}  // namespace pcrb
