#include "fetch/fetch_tool.hpp"

#include <gtest/gtest.h>
#include <rosbag/bag.h>
#include <sensor_msgs/PointCloud2.h>

#include <filesystem>
#include <set>
#include <sstream>

#include "common/process.hpp"
#include "fetch/sources.hpp"
#include "pcrb_core/error.hpp"
#include "preparation/preparation_tools.hpp"
#include "support/file_servers.hpp"
#include "support/log_folder.hpp"
#include "support/temporary_folder.hpp"

namespace pcrb_tools {
namespace {

namespace fs = std::filesystem;
using pcrb_test::readFile;
using pcrb_test::writeFile;

const std::string kCloud =
    "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 2\nHEIGHT 1\n"
    "VIEWPOINT 0 0 0 1 0 0 0\nPOINTS 2\nDATA ascii\n0 0 0\n1 0 0\n";

const std::string kProblems =
    "id source target overlap t1 t2 t3 t4 t5 t6 t7 t8 t9 t10 t11 t12\n"
    "4215528470000 a.pcd b.pcd 0.5 1 0 0 0.1 0 1 0 0 0 0 1 0\n";

/// Sources on local servers: a published archive, a published problem file, an original log.
class FetchToolTest : public ::testing::Test {
 protected:
  FetchToolTest() : servers_(folder_.path()) {
    std::string other = kCloud;
    other.replace(other.find("1 0 0\n"), 1, "3");
    pcrb_test::writeArchive(folder_.file("plain.zip"),
                            {{"plain/a.pcd", kCloud}, {"plain/b.pcd", other}, {"readme.txt", "x"}});
    pcrb_test::writeArchive(folder_.file("log.zip"), {{"csv_global/PointCloud0.csv", "x"}});
    writeFile(folder_.file("plain_local.txt"), kProblems);
    options_.sources = folder_.file("sources.yaml");
    options_.logs = folder_.file("logs");
    options_.root = folder_.file("root");
    options_.policy.first_delay = std::chrono::milliseconds(0);
    options_.policy.attempts = 3;
    options_.convert = [this](const SequenceLog& log) {
      converted_.push_back(log);
      return conversion_succeeds_;
    };
    options_.check = [this](const std::vector<std::string>& sequences, std::ostream& out) {
      CheckOptions check;
      check.root = options_.root;
      check.sequences = sequences;
      return runCheckTool(check, out);
    };
    setSources(servers_.http("/drive?id=plain.zip"), servers_.http("/files/plain_local.txt"));
  }

  void setSources(const std::string& archive, const std::string& problems) {
    writeFile(
        options_.sources,
        "sources:\n"
        "  - {data_set: eth, sequence: plain, set: published, kind: clouds, google_drive: true,\n"
        "     file: published/plain.zip, url: \"" +
            archive +
            "\"}\n"
            "  - {data_set: eth, sequence: plain, set: published, kind: problems,\n"
            "     file: problems/plain_local.txt, url: \"" +
            problems +
            "\"}\n"
            "  - {data_set: eth, sequence: plain, set: original, kind: log, file: eth/plain.zip,\n"
            "     url: \"" +
            servers_.ftp("/files/log.zip") +
            "\"}\n"
            "  - {data_set: kaist, sequence: urban05, set: original, kind: log, file: "
            "kaist/urban05.tar.gz,\n"
            "     by_hand: register and download it}\n");
  }

  bool fetch() {
    std::ostringstream out;
    const bool is_sound = runFetchTool(options_, out);
    output_ = out.str();
    return is_sound;
  }

  bool says(const std::string& part) const { return output_.find(part) != std::string::npos; }

  pcrb_test::TemporaryFolder folder_;
  pcrb_test::FileServers servers_;
  FetchOptions options_;
  std::vector<SequenceLog> converted_;
  bool conversion_succeeds_ = true;
  std::string output_;
};

TEST_F(FetchToolTest, PutsPublishedFilesIntoTheCommonLayoutAndChecksThem) {
  EXPECT_TRUE(fetch()) << output_;
  EXPECT_EQ(readFile(folder_.file("root/eth/plain/a.pcd")), kCloud);
  EXPECT_EQ(readFile(folder_.file("root/eth/plain_local.txt")), kProblems);
  EXPECT_EQ(pcrb_test::namesIn(folder_.file("root/eth/plain")),
            (std::vector<std::string>{"a.pcd", "b.pcd"}));
  EXPECT_TRUE(says("2 of 2 files are there")) << output_;
  EXPECT_TRUE(says("0 errors")) << output_;
  EXPECT_NE(readFile(folder_.file("logs/SHA256SUMS")).find("  published/plain.zip\n"),
            std::string::npos);
}

TEST_F(FetchToolTest, ARerunNeedsNoServerAndKeepsWhatIsThere) {
  EXPECT_TRUE(fetch()) << output_;
  setSources("http://127.0.0.1:1/plain.zip", "http://127.0.0.1:1/plain_local.txt");
  const auto made = fs::last_write_time(folder_.file("root/eth/plain/a.pcd"));
  EXPECT_TRUE(fetch()) << output_;
  EXPECT_EQ(fs::last_write_time(folder_.file("root/eth/plain/a.pcd")), made);
  fs::remove(folder_.file("root/eth/plain/b.pcd"));
  EXPECT_TRUE(fetch()) << output_;
  EXPECT_TRUE(fs::exists(folder_.file("root/eth/plain/b.pcd")));
}

TEST_F(FetchToolTest, AFileThatChangedSinceItWasFetchedIsAnError) {
  EXPECT_TRUE(fetch()) << output_;
  pcrb_test::writeArchive(folder_.file("logs/published/plain.zip"), {{"a.pcd", "other"}});
  EXPECT_FALSE(fetch());
  EXPECT_TRUE(says("error: " + folder_.file("logs/published/plain.zip") + ": found SHA-256"))
      << output_;
}

TEST_F(FetchToolTest, DryRunOnlySaysWhatItWouldDo) {
  options_.dry_run = true;
  options_.set = SourceSet::kOriginal;
  EXPECT_TRUE(fetch());
  EXPECT_TRUE(says("eth/plain: download ftp://")) << output_;
  EXPECT_TRUE(says("kaist/urban05: needs you: register and download it; there = " + options_.logs +
                   "/kaist/urban05.tar.gz"))
      << output_;
  EXPECT_FALSE(fs::exists(options_.logs));
  EXPECT_FALSE(fs::exists(options_.root));
}

TEST_F(FetchToolTest, TakesFilesThatTheUserHas) {
  fs::create_directories(folder_.file("mine"));
  fs::copy_file(folder_.file("plain.zip"), folder_.file("mine/plain.zip"));
  setSources("http://127.0.0.1:1/plain.zip", servers_.http("/files/plain_local.txt"));
  options_.from = folder_.file("mine");
  EXPECT_TRUE(fetch()) << output_;
  EXPECT_TRUE(fs::is_symlink(folder_.file("logs/published/plain.zip")));
  EXPECT_EQ(readFile(folder_.file("root/eth/plain/a.pcd")), kCloud);
}

TEST_F(FetchToolTest, OneFailureDoesNotKeepOthersFromBeingFetched) {
  setSources(servers_.http("/quota?id=plain.zip"), servers_.http("/files/plain_local.txt"));
  options_.prepare = false;
  EXPECT_FALSE(fetch());
  EXPECT_TRUE(says("error: ")) << output_;
  EXPECT_TRUE(says("1 of 2 files are there")) << output_;
  EXPECT_TRUE(fs::exists(folder_.file("root/eth/plain_local.txt")));
}

TEST_F(FetchToolTest, AnHtmlPageIsNoArchive) {
  setSources(servers_.http("/page/plain.zip"), servers_.http("/files/plain_local.txt"));
  EXPECT_FALSE(fetch());
  EXPECT_TRUE(says("an HTML page")) << output_;
  EXPECT_FALSE(fs::exists(folder_.file("logs/published/plain.zip")));
}

TEST_F(FetchToolTest, DoesNotReplaceProblemsOfTheUsers) {
  writeFile(folder_.file("root/eth/plain_local.txt"), "my own\n");
  EXPECT_FALSE(fetch());
  EXPECT_TRUE(says("is there and is not what was published")) << output_;
  EXPECT_EQ(readFile(folder_.file("root/eth/plain_local.txt")), "my own\n");
}

TEST_F(FetchToolTest, DoesNotReplaceACloudOfTheUsersUnlessForced) {
  const std::string cloud = folder_.file("root/eth/plain/a.pcd");
  std::string converted = kCloud;
  converted.back() = ' ';
  writeFile(cloud, converted);
  EXPECT_FALSE(fetch());
  EXPECT_TRUE(says("error: " + cloud + ": is there and is not what was published (" +
                   folder_.file("logs/published/plain.zip") + "/plain/a.pcd); move it away, or"))
      << output_;
  EXPECT_EQ(readFile(cloud), converted);
  options_.force = true;
  EXPECT_TRUE(fetch()) << output_;
  EXPECT_EQ(readFile(cloud), kCloud);
}

TEST_F(FetchToolTest, ADamagedDownloadIsNotRecordedAndTheMendedOneIsTaken) {
  const std::string served = folder_.file("plain.zip");
  const std::string whole = readFile(served);
  pcrb_test::damage(served, 100);
  EXPECT_FALSE(fetch());
  EXPECT_TRUE(says("plain.zip.part: damaged or no archive")) << output_;
  writeFile(served, whole);
  EXPECT_TRUE(fetch()) << output_;
}

TEST_F(FetchToolTest, ARecordedSumOfADamagedFileIsNamedByTheLineToDelete) {
  const std::string sums = folder_.file("logs/SHA256SUMS");
  EXPECT_TRUE(fetch()) << output_;
  const std::string text = readFile(sums);
  const std::string problems_row = text.substr(0, text.find('\n') + 1);
  writeFile(sums, problems_row + std::string(64, '0') + "  published/plain.zip\n");
  fs::remove(folder_.file("logs/published/plain.zip"));
  EXPECT_FALSE(fetch());
  EXPECT_TRUE(says("recorded in " + sums +
                   ":2; if that was of a damaged file, delete that line to take this one"))
      << output_;
  writeFile(sums, problems_row);
  EXPECT_TRUE(fetch()) << output_;
  EXPECT_EQ(readFile(sums), text);
}

TEST_F(FetchToolTest, BytesThatAreNoCloudGetNoCloudsName) {
  const auto use = [&](const std::string& kind, const std::string& file) {
    writeFile(options_.sources,
              "sources:\n  - {data_set: eth, sequence: plain, set: published, kind: " + kind +
                  ", file: " + file + ", url: \"" + servers_.http("/files/absent") + "\"}\n");
  };
  const std::string bytes = "published bytes, not even a cloud";
  fs::create_directories(options_.logs);
  pcrb_test::writeArchive(folder_.file("logs/a.zip"), {{"map.pcd", bytes}});
  use("clouds", "a.zip");
  EXPECT_FALSE(fetch());
  EXPECT_TRUE(says("error: " + folder_.file("logs/a.zip/map.pcd:1: found"))) << output_;
  writeFile(folder_.file("logs/map.pcd"), bytes);
  use("cloud", "map.pcd");
  EXPECT_FALSE(fetch());
  EXPECT_TRUE(says("error: " + folder_.file("logs/map.pcd:1: found"))) << output_;
  EXPECT_FALSE(fs::exists(folder_.file("root/eth/plain/map.pcd")));
}

TEST_F(FetchToolTest, EveryPublishedSequenceIsFetchedWithItsClouds) {
  options_.sources = PCRB_TOOLS_FOLDER "/config/datasets.yaml";
  options_.dry_run = true;
  std::set<std::string> sequences;
  for (const Source& source : readSources(options_.sources)) {
    if (source.kind == SourceKind::kProblems) sequences.insert(source.name());
  }
  EXPECT_EQ(sequences.size(), 15U);
  for (const std::string& sequence : sequences) {
    options_.sequences = {sequence};
    EXPECT_TRUE(fetch());
    const bool is_map = sequence == "planetary/planetary_map";
    EXPECT_TRUE(says((is_map ? "planetary/p2at_met" : sequence) + ": download ")) << output_;
    EXPECT_TRUE(says(".zip\n") || says(".zip, ")) << output_;  // with its size, where it is known
    EXPECT_EQ(says("/box_map.pcd\n"), is_map || sequence == "planetary/p2at_met") << output_;
    EXPECT_EQ(says("/p2at_met_local.txt\n"), sequence == "planetary/p2at_met") << output_;
  }
}

TEST_F(FetchToolTest, ConvertsOriginalLogsAndPassesAFailureOn) {
  options_.set = SourceSet::kOriginal;
  options_.sequences = {"eth"};
  EXPECT_TRUE(fetch()) << output_;
  EXPECT_TRUE(fs::exists(folder_.file("logs/eth/plain.zip")));
  ASSERT_EQ(converted_.size(), 1U);
  EXPECT_EQ(converted_[0].data_set + "/" + converted_[0].sequence, "eth/plain");
  EXPECT_EQ(converted_[0].inputs, std::vector<std::string>{options_.logs + "/eth/plain.zip"});
  conversion_succeeds_ = false;
  EXPECT_FALSE(fetch());
  EXPECT_TRUE(says("error: eth/plain: its conversion failed")) << output_;
}

TEST_F(FetchToolTest, ALogThatLacksAFileIsNotConverted) {
  const auto set = [this](const std::string& poses) {
    writeFile(
        options_.sources,
        "sources:\n"
        "  - {data_set: tum, sequence: s, set: original, kind: log, file: tum/s.bag, url: \"" +
            servers_.http("/files/s.bag") +
            "\"}\n  - {data_set: tum, sequence: s, set: original, kind: log, "
            "file: tum/s-groundtruth.txt, url: \"" +
            servers_.http(poses) + "\"}\n");
  };
  options_.set = SourceSet::kOriginal;
  rosbag::Bag(folder_.file("s.bag"), rosbag::bagmode::Write).close();
  writeFile(folder_.file("s.txt"), "# poses\n");
  set("/page/s.txt");
  EXPECT_FALSE(fetch());
  EXPECT_TRUE(says("s-groundtruth.txt.part: found an HTML page, expected data")) << output_;
  EXPECT_TRUE(says("tum/s: not converted, as not all of its files are there")) << output_;
  EXPECT_TRUE(converted_.empty());
  set("/files/s.txt");
  EXPECT_TRUE(fetch()) << output_;
  ASSERT_EQ(converted_.size(), 1U);
  EXPECT_EQ(converted_[0].inputs, std::vector<std::string>{options_.logs + "/tum/s.bag"});
}

TEST_F(FetchToolTest, SomethingElseIsNoBagAndATruncatedArchiveIsNoArchive) {
  writeFile(folder_.file("mine/plain.zip"), readFile(folder_.file("plain.zip")).substr(0, 200));
  options_.from = folder_.file("mine");
  EXPECT_FALSE(fetch());
  EXPECT_TRUE(says("error: " + folder_.file("mine/plain.zip") + ": damaged")) << output_;
  EXPECT_FALSE(fs::exists(folder_.file("logs/published/plain.zip")));

  writeFile(options_.sources,
            "sources:\n  - {data_set: tum, sequence: s, set: original, kind: log, file: tum/s.bag, "
            "bytes: 9, url: \"" +
                servers_.http("/files/plain_local.txt") + "\"}\n");
  options_.set = SourceSet::kOriginal;
  EXPECT_FALSE(fetch());
  EXPECT_TRUE(says("bytes, expected 9")) << output_;
  writeFile(options_.sources,
            "sources:\n  - {data_set: tum, sequence: s, set: original, kind: log, file: tum/s.bag, "
            "url: \"" +
                servers_.http("/files/plain_local.txt") + "\"}\n");
  EXPECT_FALSE(fetch());
  EXPECT_TRUE(says("expected a bag of ROS 1")) << output_;
  rosbag::Bag bag(folder_.file("s.bag"), rosbag::bagmode::Write);
  bag.write("/points", ros::Time(1), sensor_msgs::PointCloud2());
  bag.close();
  const std::string bytes = readFile(folder_.file("s.bag"));
  writeFile(folder_.file("cut.bag"), bytes.substr(0, bytes.size() - 100));
  writeFile(options_.sources,
            "sources:\n  - {data_set: tum, sequence: s, set: original, kind: log, file: tum/s.bag, "
            "url: \"" +
                servers_.http("/files/cut.bag") + "\"}\n");
  EXPECT_FALSE(fetch());
  EXPECT_TRUE(says("of a bag that is cut or damaged")) << output_;
  EXPECT_EQ(pcrb_test::namesIn(folder_.file("logs/tum")), std::vector<std::string>{});
}

TEST_F(FetchToolTest, TriesThePlacesOfAFileInTurnAndNamesEachThatFails) {
  writeFile(folder_.file("s.txt"), "# poses\n");
  const auto set = [this](const std::string& last) {
    writeFile(
        options_.sources,
        "sources:\n  - {data_set: tum, sequence: s, set: original, kind: log, file: tum/s.txt, "
        "bytes: 1500000000,\n     url: \"" +
            servers_.http("/files/gone.txt") + "\", mirrors: [{url: \"" +
            servers_.http("/page/s.txt") + "\"}, {url: \"" + servers_.http(last) +
            "\", bytes: 8}]}\n");
  };
  options_.set = SourceSet::kOriginal;
  set("/files/none.txt");
  EXPECT_FALSE(fetch());
  EXPECT_TRUE(says("tum/s.txt: none of 3 places has it: ")) << output_;
  for (const char* cause : {"gone.txt: the server answers with status 404", "found an HTML page",
                            "none.txt: the server answers with status 404"}) {
    EXPECT_TRUE(says(cause)) << cause << " in " << output_;
  }
  set("/files/s.txt");
  options_.dry_run = true;
  EXPECT_TRUE(fetch());
  EXPECT_TRUE(says(", 1.50 GB")) << output_;
  EXPECT_TRUE(says("known in all: 1.50 GB, 0.0 h at 10 MB/s")) << output_;
  options_.dry_run = false;
  EXPECT_TRUE(fetch()) << output_;
  EXPECT_EQ(readFile(options_.logs + "/tum/s.txt"), "# poses\n");
  EXPECT_TRUE(fetch()) << output_;
}

TEST_F(FetchToolTest, SaysHowToGetWhatCannotBeDownloaded) {
  options_.set = SourceSet::kOriginal;
  options_.sequences = {"kaist/urban05"};
  EXPECT_FALSE(fetch());
  EXPECT_TRUE(says("error: kaist/urban05 cannot be downloaded: register and download it"))
      << output_;
  options_.sequences = {"kaist/urban99"};
  EXPECT_THROW(fetch(), pcrb::InvalidParameter);
}

TEST(FetchDatasets, RunsTheConverterOfWhatItDownloadedAndPassesItsFailureOn) {
  const pcrb_test::TemporaryFolder folder;
  const pcrb_test::FileServers servers(folder.path());
  writeFile(folder.file("sources.yaml"),
            "sources:\n  - {data_set: planetary, sequence: box_met, set: both, kind: log, "
            "file: planetary/box_met.zip, url: \"" +
                servers.ftp("/broken/log.zip") + "\"}\n");
  const auto status_with_pose = [&](const std::string& pose) {
    const std::string scan = "box_met/box_met_000/box_met_000";
    pcrb_test::writeArchive(folder.file("log.zip"),
                            {{scan + ".xyz", "1 2 3\n4 5 6\n"}, {scan + ".gt", pose}});
    fs::remove_all(folder.file("logs"));
    fs::remove_all(folder.file("root"));
    return runChild({PCRB_TOOLS_PROGRAMS "/fetch_datasets", "--original", "--sources",
                     folder.file("sources.yaml"), "--logs", folder.file("logs"), "--root",
                     folder.file("root")});
  };
  EXPECT_EQ(status_with_pose("1 0 0 5\n0 1 0 0\n0 0 1 0\n0 0 0 1\n"), 0);
  const std::string cloud = readFile(folder.file("root/planetary/box_met/box_met_000.pcd"));
  EXPECT_NE(cloud.find("\n6 2 3\n9 5 6\n"), std::string::npos) << cloud;
  EXPECT_EQ(status_with_pose("1 0 0 5\n0 1 0 0\n"), 1);
}

TEST(ChildProcess, GivesItsExitStatusAndSaysIfItCannotBeRun) {
  EXPECT_EQ(runChild({"/bin/sh", "-c", "exit 7"}), 7);
  EXPECT_EQ(runChild({"/bin/sh", "-c", "kill -TERM $$"}), 128 + 15);
  EXPECT_THROW(runChild({"/absent/program"}), pcrb::InvalidFile);
}

}  // namespace
}  // namespace pcrb_tools
