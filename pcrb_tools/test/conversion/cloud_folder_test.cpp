#include "conversion/cloud_folder.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "pcrb_core/error.hpp"
#include "support/expect_error.hpp"
#include "support/log_folder.hpp"
#include "support/temporary_folder.hpp"

namespace pcrb_tools {
namespace {

pcrb::DatasetCloud cloudAt(double x) {
  pcrb::DatasetCloud cloud;
  cloud.points = {{x, 2.0, 3.0}};
  return cloud;
}

TEST(CloudFolder, KeepsACloudOfTheSameOriginWithItsCounts) {
  const pcrb_test::TemporaryFolder root;
  CloudFolder(root.path(), "eth", "plain").write("a.pcd", "f1", cloudAt(1), {10, 3, 2, 1})();
  const CloudFolder folder(root.path(), "eth", "plain");
  EXPECT_EQ(folder.path(), root.path() + "/eth/plain");
  const auto counts = folder.kept("a.pcd", "f1");
  ASSERT_TRUE(counts);
  EXPECT_EQ(counts->read, 10u);
  EXPECT_EQ(counts->written(), 4u);
  EXPECT_FALSE(folder.kept("a.pcd", "another"));
  EXPECT_FALSE(folder.kept("b.pcd", "f1"));
}

TEST(CloudFolder, NothingIsThereOfACloudUntilItIsCommitted) {
  const pcrb_test::TemporaryFolder root;
  CloudFolder folder(root.path(), "eth", "plain");
  folder.write("a.pcd", "f1", cloudAt(1), {});
  EXPECT_EQ(pcrb_test::namesIn(folder.path()), std::vector<std::string>{".conversion"});
  const auto commit = folder.write("a.pcd", "f1", cloudAt(1), {});
  EXPECT_FALSE(folder.kept("a.pcd", "f1"));
  commit();
  EXPECT_TRUE(folder.kept("a.pcd", "f1"));
  EXPECT_EQ(pcrb_test::namesIn(folder.path()), (std::vector<std::string>{".conversion", "a.pcd"}));
}

TEST(CloudFolder, DoesNotKeepACloudThatWasChangedOrRemoved) {
  const pcrb_test::TemporaryFolder root;
  {
    CloudFolder folder(root.path(), "eth", "plain");
    folder.write("a.pcd", "f1", cloudAt(1), {})();
    folder.write("b.pcd", "f2", cloudAt(1), {})();
  }
  std::ofstream(root.path() + "/eth/plain/a.pcd", std::ios::app) << "1 2 3\n";
  std::filesystem::remove(root.path() + "/eth/plain/b.pcd");
  const CloudFolder folder(root.path(), "eth", "plain");
  EXPECT_FALSE(folder.kept("a.pcd", "f1"));
  EXPECT_FALSE(folder.kept("b.pcd", "f2"));
}

TEST(CloudFolder, ARecordThatAKillHasCutIsNotBelieved) {
  const pcrb_test::TemporaryFolder root;
  {
    CloudFolder folder(root.path(), "eth", "plain");
    folder.write("a.pcd", "f1", cloudAt(1), {})();
    folder.write("b.pcd", "f2", cloudAt(1), {})();
  }
  const std::string records = root.path() + "/eth/plain/.conversion";
  std::filesystem::resize_file(records, std::filesystem::file_size(records) - 3);
  CloudFolder folder(root.path(), "eth", "plain");
  EXPECT_TRUE(folder.kept("a.pcd", "f1"));
  EXPECT_FALSE(folder.kept("b.pcd", "f2"));
}

TEST(CloudFolder, ARecordAfterACutOneIsRead) {
  const pcrb_test::TemporaryFolder root;
  pcrb_test::writeFile(root.path() + "/eth/plain/.conversion", "a.pcd\tf1\t12");
  CloudFolder(root.path(), "eth", "plain").write("b.pcd", "f2", cloudAt(1), {})();
  EXPECT_TRUE(CloudFolder(root.path(), "eth", "plain").kept("b.pcd", "f2"));
}

TEST(CloudFolder, ClearsWhatAKilledRunHasLeftHalfWritten) {
  const pcrb_test::TemporaryFolder root;
  pcrb_test::writeFile(root.path() + "/eth/plain/.a.pcd.123-0.tmp", "half");
  const CloudFolder folder(root.path(), "eth", "plain");
  EXPECT_EQ(pcrb_test::namesIn(folder.path()), std::vector<std::string>{".conversion"});
}

TEST(CloudFolder, IsWrittenByOneConversionAtATime) {
  const pcrb_test::TemporaryFolder root;
  const CloudFolder first(root.path(), "eth", "plain");
  PCRB_EXPECT_ERROR(pcrb::InvalidFile, CloudFolder(root.path(), "eth", "plain"),
                    "another process is writing");
}

TEST(CloudFolder, NamesCloudsThatAreNotOfThisConversion) {
  const pcrb_test::TemporaryFolder root;
  pcrb_test::writeFiles(root.path() + "/planetary/p2at_met",
                        {{"box_map.pcd", ""}, {"old.pcd", ""}, {"new.pcd", ""}, {"notes.txt", ""}});
  const CloudFolder folder(root.path(), "planetary", "p2at_met");
  EXPECT_EQ(folder.othersThan({"new.pcd"}), std::vector<std::string>{"old.pcd"});
}

TEST(CloudFolder, NamesOfFoldersAreChecked) {
  const pcrb_test::TemporaryFolder root;
  for (const char* name : {"", "..", "a/b", ".hidden"}) {
    EXPECT_THROW(CloudFolder(root.path(), "eth", name), pcrb::InvalidParameter) << name;
    EXPECT_THROW(CloudFolder(root.path(), name, "plain"), pcrb::InvalidParameter) << name;
  }
}

}  // namespace
}  // namespace pcrb_tools
