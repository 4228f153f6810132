#include "pcrb_core/io/cloud_files.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "pcrb_core/error.hpp"
#include "support/temporary_folder.hpp"

namespace pcrb {
namespace {

TEST(CloudFiles, AreInTheOrderThatAPersonCounts) {
  const std::vector<std::string> expected{
      "1311878220.377686160.pcd", "1311878220.977686160.pcd", "PointCloud0.pcd",
      "PointCloud2.pcd",          "PointCloud10.pcd",         "box_map.pcd",
      "box_met_007.pcd",          "box_met_010.pcd",          "box_met_0100.pcd"};
  std::vector<std::string> names(expected.rbegin(), expected.rend());
  std::sort(names.begin(), names.end(), naturalLess);
  EXPECT_EQ(names, expected);
}

TEST(CloudFiles, OrderIsStrictForNamesThatDifferInZerosOnly) {
  EXPECT_TRUE(naturalLess("a007", "a07"));
  EXPECT_FALSE(naturalLess("a07", "a007"));
  EXPECT_TRUE(naturalLess("a", "a0"));
  EXPECT_FALSE(naturalLess("a1", "a1"));
}

TEST(CloudFiles, FindsOnlyPcdFilesThatAreNotHidden) {
  const pcrb_test::TemporaryFolder folder;
  for (const char* name : {"b10.pcd", "b9.pcd", ".b9.pcd.tmp.pcd", "readme.txt", "x.pcd.yaml"}) {
    std::ofstream(folder.file(name)) << "x";
  }
  EXPECT_EQ(findClouds(folder.path()), (std::vector<std::string>{"b9.pcd", "b10.pcd"}));
  EXPECT_THROW(findClouds(folder.file("absent")), InvalidFile);
}

}  // namespace
}  // namespace pcrb
