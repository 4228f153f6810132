#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>

#include "fetch/published_files.hpp"
#include "pcrb_core/error.hpp"
#include "support/expect_error.hpp"
#include "support/log_folder.hpp"
#include "support/temporary_folder.hpp"

namespace pcrb_tools {
namespace {

using pcrb_test::readFile;
using pcrb_test::writeFile;

namespace fs = std::filesystem;

const std::string kSmallCloud =
    "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 2\nHEIGHT 1\n"
    "VIEWPOINT 0 0 0 1 0 0 0\nPOINTS 2\nDATA ascii\n0 0 0\n1 0 0\n";
const std::string kOther = kSmallCloud.substr(0, kSmallCloud.size() - 6) + "2 0 0\n";

TEST(Unpack, UsesTheLastPartOfNamesAndRefusesHostileOnes) {
  const pcrb_test::TemporaryFolder folder;
  const std::string archive = folder.file("a.zip");
  const std::string target = folder.file("clouds");
  pcrb_test::writeArchive(archive, {{"deep/er/a.pcd", kSmallCloud},
                                    {"b.pcd", kOther},
                                    {"run.sh", "x"},
                                    {"__MACOSX/._b.pcd", "x"}});
  EXPECT_EQ(unpackClouds(archive, "h1", target), 2U);
  EXPECT_EQ(pcrb_test::namesIn(target), (std::vector<std::string>{"a.pcd", "b.pcd"}));
  for (const char* name : {"../evil.pcd", "/tmp/evil.pcd", "a/../../evil.pcd"}) {
    pcrb_test::writeArchive(archive, {{name, kSmallCloud}});
    EXPECT_THROW(unpackClouds(archive, "h2", target), pcrb::InvalidFile) << name;
  }
  pcrb_test::writeArchive(archive, {{"x/a.pcd", kSmallCloud}, {"y/a.pcd", kOther}});
  EXPECT_THROW(unpackClouds(archive, "h3", target), pcrb::InvalidFile);
  pcrb_test::writeArchive(archive, {{"readme.txt", "1"}});
  EXPECT_THROW(unpackClouds(archive, "h4", target), pcrb::InvalidFile);
  EXPECT_EQ(pcrb_test::namesIn(folder.path()),
            (std::vector<std::string>{"a.zip", "a.zip.unpacked", "clouds"}));
}

TEST(Unpack, ADamagedArchiveIsUnpackedAgainWhenItIsWhole) {
  const pcrb_test::TemporaryFolder folder;
  const std::string archive = folder.file("a.tgz");
  pcrb_test::writeArchive(archive, {{"a.pcd", kSmallCloud}, {"b.pcd", kOther}});
  const std::string whole = readFile(archive);
  writeFile(archive, whole.substr(0, whole.size() / 2));
  EXPECT_THROW(unpackClouds(archive, "h", folder.file("clouds")), pcrb::InvalidFile);
  writeFile(archive, whole);
  EXPECT_EQ(unpackClouds(archive, "h", folder.file("clouds")), 2U);
}

TEST(Unpack, AnOlderCloudOfTheSameSizeIsNotWhatWasUnpackedAndIsNotReplaced) {
  const pcrb_test::TemporaryFolder folder;
  const std::string archive = folder.file("a.zip");
  const std::string target = folder.file("clouds");
  const std::string cloud = target + "/a.pcd";
  pcrb_test::writeArchive(archive, {{"a.pcd", kSmallCloud}});
  unpackClouds(archive, "h", target);
  const auto unpacked = fs::last_write_time(cloud);
  writeFile(cloud, kOther);
  fs::last_write_time(cloud, unpacked - std::chrono::hours(1));
  PCRB_EXPECT_ERROR(pcrb::InvalidFile, unpackClouds(archive, "h", target),
                    "is there and is not what was published");
  EXPECT_EQ(readFile(cloud), kOther);
}

TEST(Unpack, AnArchiveThatChangedReplacesWhatItHadGiven) {
  const pcrb_test::TemporaryFolder folder;
  const std::string archive = folder.file("a.zip");
  const std::string target = folder.file("clouds");
  pcrb_test::writeArchive(archive, {{"a.pcd", kSmallCloud}});
  unpackClouds(archive, "h1", target);
  pcrb_test::writeArchive(archive, {{"a.pcd", kOther}});
  EXPECT_EQ(unpackClouds(archive, "h2", target), 1U);
  EXPECT_EQ(readFile(target + "/a.pcd"), kOther);
}

TEST(Unpack, WhatIsThereAlreadyFromAnInterruptedRunIsLeftAlone) {
  const pcrb_test::TemporaryFolder folder;
  const std::string archive = folder.file("a.zip");
  const std::string cloud = folder.file("clouds/a.pcd");
  pcrb_test::writeArchive(archive, {{"a.pcd", kSmallCloud}, {"b.pcd", kOther}});
  writeFile(cloud, kSmallCloud);
  const auto made = fs::last_write_time(cloud);
  EXPECT_EQ(unpackClouds(archive, "h", folder.file("clouds")), 2U);
  EXPECT_EQ(fs::last_write_time(cloud), made);
}

}  // namespace
}  // namespace pcrb_tools
