#include "pcrb_tools/fetch/fetch_tool.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <sstream>

#include "pcrb_core/error.hpp"
#include "pcrb_tools/fetch/sources.hpp"
#include "pcrb_tools/fetch/unpack.hpp"
#include "pcrb_tools/run_child.hpp"
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
  options_.original = true;
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

TEST_F(FetchToolTest, ConvertsOriginalLogsAndPassesAFailureOn) {
  options_.original = true;
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
  options_.original = true;
  writeFile(folder_.file("s.bag"), "#ROSBAG V2.0\nrest");
  writeFile(folder_.file("s.txt"), "# poses\n");
  set("/page/s.txt");
  EXPECT_FALSE(fetch());
  EXPECT_TRUE(says("s-groundtruth.txt.part: found an HTML page, expected a log")) << output_;
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
  options_.original = true;
  EXPECT_FALSE(fetch());
  EXPECT_TRUE(says("bytes, expected 9")) << output_;
  writeFile(options_.sources,
            "sources:\n  - {data_set: tum, sequence: s, set: original, kind: log, file: tum/s.bag, "
            "url: \"" +
                servers_.http("/files/plain_local.txt") + "\"}\n");
  EXPECT_FALSE(fetch());
  EXPECT_TRUE(says("expected a bag of ROS 1")) << output_;
  EXPECT_EQ(pcrb_test::namesIn(folder_.file("logs/tum")), std::vector<std::string>{});
}

TEST_F(FetchToolTest, SaysHowToGetWhatCannotBeDownloaded) {
  options_.original = true;
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

TEST(Unpack, UsesTheLastPartOfNamesAndRefusesHostileOnes) {
  const pcrb_test::TemporaryFolder folder;
  const std::string archive = folder.file("a.zip");
  const std::string target = folder.file("clouds");
  pcrb_test::writeArchive(
      archive,
      {{"deep/er/a.pcd", "1"}, {"b.pcd", "22"}, {"run.sh", "x"}, {"__MACOSX/._b.pcd", "x"}});
  EXPECT_EQ(unpackClouds(archive, "h1", target), 2U);
  EXPECT_EQ(pcrb_test::namesIn(target), (std::vector<std::string>{"a.pcd", "b.pcd"}));
  for (const char* name : {"../evil.pcd", "/tmp/evil.pcd", "a/../../evil.pcd"}) {
    pcrb_test::writeArchive(archive, {{name, "1"}});
    EXPECT_THROW(unpackClouds(archive, "h2", target), pcrb::InvalidFile) << name;
  }
  pcrb_test::writeArchive(archive, {{"x/a.pcd", "1"}, {"y/a.pcd", "2"}});
  EXPECT_THROW(unpackClouds(archive, "h3", target), pcrb::InvalidFile);
  pcrb_test::writeArchive(archive, {{"readme.txt", "1"}});
  EXPECT_THROW(unpackClouds(archive, "h4", target), pcrb::InvalidFile);
  EXPECT_EQ(pcrb_test::namesIn(folder.path()),
            (std::vector<std::string>{"a.zip", "a.zip.unpacked", "clouds"}));
}

TEST(Unpack, ADamagedArchiveIsUnpackedAgainWhenItIsWhole) {
  const pcrb_test::TemporaryFolder folder;
  const std::string archive = folder.file("a.tgz");
  pcrb_test::writeArchive(archive, {{"a.pcd", std::string(100000, 'a')}, {"b.pcd", "b"}});
  const std::string whole = readFile(archive);
  writeFile(archive, whole.substr(0, whole.size() / 2));
  EXPECT_THROW(unpackClouds(archive, "h", folder.file("clouds")), pcrb::InvalidFile);
  writeFile(archive, whole);
  EXPECT_EQ(unpackClouds(archive, "h", folder.file("clouds")), 2U);
}

TEST(Sources, OfThePackageCoverAllPublishedSequences) {
  const auto sources = readSources(PCRB_TOOLS_FOLDER "/config/datasets.yaml");
  std::size_t problems = 0;
  for (const Source& source : sources) problems += source.kind == SourceKind::kProblems ? 1 : 0;
  EXPECT_EQ(problems, 30U);  // 15 lists for each kind
}

TEST(Sources, RejectsMistakesWithTheirLine) {
  const pcrb_test::TemporaryFolder folder;
  const std::string good =
      "{data_set: d, sequence: s, set: both, kind: log, file: f, url: \"http://x\"}";
  const auto error_of = [&](const std::string& entry) {
    writeFile(folder.file("s.yaml"), "sources:\n  - " + good + "\n  - " + entry + "\n");
    try {
      readSources(folder.file("s.yaml"));
    } catch (const pcrb::InvalidFile& error) {
      return std::string(error.what()).substr(folder.path().size() + 1);
    }
    return std::string("accepted");
  };
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string entry = good;
    entry.replace(entry.find("file: f"), 7, "file: g");
    entry.replace(entry.find(from), from.size(), to);
    return entry;
  };
  EXPECT_EQ(error_of(good), "s.yaml:3: found f again, expected every file once");
  EXPECT_EQ(error_of(with("file: g", "file: ../g")),
            "s.yaml:3: found '../g', expected a name below its folder");
  EXPECT_EQ(error_of(with("data_set: d", "data_set: /d")),
            "s.yaml:3: found '/d', expected a name below its folder");
  EXPECT_EQ(error_of(with("http://x", "file:///etc/passwd")),
            "s.yaml:3: found 'file:///etc/passwd', expected an address of http, https or ftp");
  EXPECT_EQ(error_of(with("kind: log", "kind: tape")),
            "s.yaml:3: found 'tape', expected cloud, clouds, log, problems");
  EXPECT_EQ(error_of(with("kind: log", "colour: red, kind: log")),
            "s.yaml:3: found 'colour', expected a known key");
  EXPECT_EQ(error_of(with("kind: log", "kind: log, bytes: many")),
            "s.yaml:3: found 'many', expected a number of bytes");
  EXPECT_EQ(error_of(with("kind: log", "kind: log, sha256: abc")),
            "s.yaml:3: found 'abc', expected 64 hexadecimal digits");
  EXPECT_EQ(error_of(with("kind: log, ", "")),
            "s.yaml:3: found no kind, expected data_set, sequence, set, kind and file");
  EXPECT_EQ(error_of(with("url: \"http://x\"", "by_hand: yes, url: \"http://x\"")),
            "s.yaml:3: found both, expected either url or by_hand");
  EXPECT_NE(error_of("[").find("expected YAML"), std::string::npos);
}

}  // namespace
}  // namespace pcrb_tools
