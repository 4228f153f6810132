#include "benchmarking/log_notices.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "support/temporary_folder.hpp"

namespace pcrb_tools {
namespace {

using Texts = std::vector<std::string>;

class LogNoticesTest : public testing::Test {
 protected:
  void write(const std::string& text) { std::ofstream(path(), std::ios::app) << text; }
  std::string path() const { return folder_.path() + "/roslaunch.log"; }

  pcrb_test::TemporaryFolder folder_;
};

TEST_F(LogNoticesTest, AreTheLinesThatNodesOfTheSuiteTellPeopleWithWhatIsIndentedBelow) {
  write("[localization_bridge] of an earlier start\n");
  const auto start =
      static_cast<std::streamoff>(std::ifstream(path()).seekg(0, std::ios::end).tellg());
  LogNotices notices(path(), start);
  EXPECT_EQ(notices.next(true), Texts());
  write(
      "results: /run\n  indented\n[localization_bridge] waiting for a node\n  no node\nprocess\n");
  EXPECT_EQ(notices.next(true), Texts{"localization_bridge: waiting for a node\n  no node"});
  EXPECT_EQ(notices.last("localization_bridge"), "waiting for a node\n  no node");
  EXPECT_EQ(notices.last("node_supervisor"), "");
}

TEST_F(LogNoticesTest, AreToldOnceTheirLineIsCompleteAndAgainOnlyWhenTheyChange) {
  LogNotices notices(path(), 0);
  EXPECT_EQ(notices.next(true), Texts());  // no log yet
  write("[node_supervisor] it has en");
  EXPECT_EQ(notices.next(true), Texts());
  write("ded\n[localization_bridge] waits\n[node_supervisor] it has ended\n");
  EXPECT_EQ(notices.next(true),
            (Texts{"node_supervisor: it has ended", "localization_bridge: waits"}));
  write("[node_supervisor] it comes\n[node_supervisor] it has ended\n");
  EXPECT_EQ(notices.next(true),
            (Texts{"node_supervisor: it comes", "node_supervisor: it has ended"}));
}

TEST_F(LogNoticesTest, ErrorsOfTheNodeUnderTestAreToldOnceEachAndOnlyWhileTheyAreOfInterest) {
  LogNotices notices(path(), 0);
  const std::string error = "\033[31m[ERROR] [1700000000.5]: found no ~map_path\033[0m\n";
  write(error + error + "\033[33m[ WARN] [1700000000.6]: slow\033[0m\n");
  write("Traceback (most recent call last):\n  File \"node.py\", line 1\nKeyError: 'map'\nText\n");
  EXPECT_EQ(notices.next(true), (Texts{"node under test: [ERROR] found no ~map_path",
                                       "node under test: KeyError: 'map'"}));
  write("[ERROR] [WallTime: 1.5] another\n");
  EXPECT_EQ(notices.next(false), Texts());
  for (int i = 0; i < 100; ++i) write("[FATAL] [1.5]: number " + std::to_string(i) + "\n");
  EXPECT_EQ(notices.next(true).size(), 6U);
}

TEST(ErrorOfNode, IsWhatTheNodeAndItsRoslaunchPrintWhenItDies) {
  EXPECT_EQ(
      errorOfNode("\033[31m[ndt-1] process has died [pid 7, exit code 1, cmd /a/b __name:=ndt]."),
      "[ndt-1] process has died, exit code 1");
  EXPECT_EQ(
      errorOfNode("[pcrb/localization_bridge-3] process has died [pid 7, exit code 1, cmd a]."),
      "");
  EXPECT_EQ(errorOfNode("ERROR: cannot launch node of type [a/b]: Cannot locate node"),
            "ERROR: cannot launch node of type [a/b]: Cannot locate node");
  EXPECT_EQ(errorOfNode("  what():  no map"), "what():  no map");
  EXPECT_EQ(errorOfNode("/a/b: error while loading shared libraries: libx.so: cannot open"),
            "/a/b: error while loading shared libraries: libx.so: cannot open");
  EXPECT_EQ(errorOfNode("no error at all"), "");
}

}  // namespace
}  // namespace pcrb_tools
