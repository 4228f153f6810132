#include "pcrb_core/io/derived_file.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <set>

#include "pcrb_core/error.hpp"
#include "pcrb_core/io/file_bytes.hpp"
#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"

namespace pcrb {
namespace {

namespace fs = std::filesystem;

void write(const std::string& path, const std::string& text) {
  fs::create_directories(fs::path(path).parent_path());
  std::ofstream(path) << text;
}

std::set<std::string> namesIn(const std::string& folder) {
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) {
    names.insert(entry.path().filename().string());
  }
  return names;
}

class DerivedFileTest : public testing::Test {
 protected:
  DerivedFileTest() { file_.setParameter("seed", "1"); }

  /// The same file, made from one more input.
  DerivedFile withInput(const std::string& input) const {
    DerivedFile file = file_;
    file.addInput(input);
    return file;
  }

  std::string generator() const { return generatorOf(path_, fileHash(path_)); }

  pcrb_test::TemporaryFolder folder_;
  const std::string path_ = folder_.file("plain_local.txt");
  DerivedFile file_{path_, "sample_problems"};
};

TEST_F(DerivedFileTest, ThatWasRecordedIsUpToDateAndReplaceable) {
  file_.begin();
  write(path_, "problems");
  file_.record();
  EXPECT_TRUE(file_.isUpToDate());
  EXPECT_NO_THROW(file_.requireReplaceable());
  EXPECT_FALSE(isForeign(path_));
  file_.setParameter("kind", "local");
  EXPECT_FALSE(file_.isUpToDate());
}

TEST_F(DerivedFileTest, AnInputOfTheSameSizeButAnotherTimeIsAnotherOneEvenIfItIsOlder) {
  const std::string input = folder_.file("scan.pcd");
  write(input, "one");
  write(path_, "problems");
  withInput(input).record();
  EXPECT_TRUE(withInput(input).isUpToDate());
  const std::string text = withInput(input).text();
  const auto written = fs::last_write_time(input);
  write(input, "two");
  fs::last_write_time(input, written - std::chrono::hours(1));
  EXPECT_FALSE(withInput(input).isUpToDate());
  EXPECT_NE(withInput(input).text(), text);
  fs::last_write_time(input, written);
  EXPECT_TRUE(withInput(input).isUpToDate());
}

TEST_F(DerivedFileTest, AnInputThatIsNotThereIsAnError) {
  PCRB_EXPECT_ERROR(InvalidFile, file_.addInput(folder_.file("none")), "expected a file to read");
}

TEST_F(DerivedFileTest, AKillBeforeTheRecordLeavesSomethingThatIsMadeAgain) {
  file_.begin();
  EXPECT_FALSE(file_.isUpToDate());
  EXPECT_NO_THROW(file_.requireReplaceable());
  EXPECT_FALSE(file_.isBegun()) << "there is none yet";
  write(path_, "problems");
  EXPECT_FALSE(file_.isUpToDate());
  EXPECT_NO_THROW(file_.requireReplaceable());
  EXPECT_TRUE(file_.isBegun());
  file_.setParameter("kind", "local");
  EXPECT_FALSE(file_.isBegun());
}

TEST_F(DerivedFileTest, TheNextRunClearsWhatAKilledOneHasLeft) {
  write(folder_.file(".plain_local.txt.4711-0.tmp"), "prob");
  write(folder_.file(".plain_local.txt.yaml.4711-1.tmp"), "too");
  write(folder_.file(".plain_global.txt.4712-0.tmp"), "another's");
  write(folder_.file(".plain_local.txt.notes.tmp"), "somebody's");
  file_.begin();
  EXPECT_EQ(namesIn(folder_.path()),
            (std::set<std::string>{".plain_global.txt.4712-0.tmp", ".plain_local.txt.notes.tmp",
                                   "plain_local.txt.yaml"}));
}

TEST_F(DerivedFileTest, WhatSomebodyElseMadeOrChangedIsNotReplaced) {
  write(path_, "published problems");
  EXPECT_TRUE(isForeign(path_));
  PCRB_EXPECT_ERROR(InvalidFile, file_.requireReplaceable(), "not made by");
  file_.record();
  write(path_, "edited problems");
  PCRB_EXPECT_ERROR(InvalidFile, file_.requireReplaceable(), "was changed");
}

TEST_F(DerivedFileTest, ItsGeneratorIsTheToolThatTheSideFileNames) {
  write(path_, "id source target\n");
  EXPECT_EQ(generator(), "") << "there is no side file";
  file_.record();
  EXPECT_EQ(generator(), "sample_problems");
  write(path_, "id source target overlap\n");
  EXPECT_EQ(generator(), "") << "another file is there in its place";
}

class DerivedFolderTest : public testing::Test {
 protected:
  /// Writes a file and records it.
  static void make(DerivedFolder& folder, const std::string& name, const std::string& fingerprint,
                   const std::string& note = "10\t3") {
    folder.begin(name);
    write(folder.fileOf(name), "points");
    folder.record(name, fingerprint, note);
  }

  pcrb_test::TemporaryFolder root_;
  const std::string path_ = root_.file("eth/plain");
  const std::string record_ = path_ + "/.conversion";
};

TEST_F(DerivedFolderTest, KeepsAFileOfTheSameOriginWithItsNote) {
  {
    DerivedFolder folder(path_, record_);
    make(folder, "a.pcd", "f1");
  }
  const DerivedFolder folder(path_, record_);
  EXPECT_EQ(folder.kept("a.pcd", "f1"), "10\t3");
  EXPECT_FALSE(folder.kept("a.pcd", "another"));
  EXPECT_FALSE(folder.kept("b.pcd", "f1"));
  EXPECT_TRUE(folder.isOwn("a.pcd"));
  EXPECT_EQ(folder.ownFiles(), std::vector<std::string>{"a.pcd"});
}

TEST_F(DerivedFolderTest, KeepsAFileWithoutANote) {
  {
    DerivedFolder folder(path_, record_);
    make(folder, "a.pcd", "f1");
    folder.record("a.pcd", "f1");
  }
  EXPECT_EQ(DerivedFolder(path_, record_).kept("a.pcd", "f1"), "");
}

TEST_F(DerivedFolderTest, DoesNotKeepAFileThatWasChangedOrRemoved) {
  {
    DerivedFolder folder(path_, record_);
    make(folder, "a.pcd", "f1");
    make(folder, "b.pcd", "f2");
  }
  write(path_ + "/a.pcd", "other points");
  fs::remove(path_ + "/b.pcd");
  const DerivedFolder folder(path_, record_);
  EXPECT_FALSE(folder.kept("a.pcd", "f1"));
  EXPECT_FALSE(folder.kept("b.pcd", "f2"));
  EXPECT_TRUE(folder.ownFiles().empty());
}

TEST_F(DerivedFolderTest, DoesNotReplaceWhatSomebodyElseMadeOrChanged) {
  DerivedFolder folder(path_, record_);
  make(folder, "a.pcd", "f1");
  write(path_ + "/published.pcd", "points");
  EXPECT_NO_THROW(folder.requireReplaceable("a.pcd"));
  EXPECT_NO_THROW(folder.requireReplaceable("new.pcd"));
  PCRB_EXPECT_ERROR(InvalidFile, folder.requireReplaceable("published.pcd"), "not made by");
  write(path_ + "/a.pcd", "other points");
  PCRB_EXPECT_ERROR(InvalidFile, folder.requireReplaceable("a.pcd"), "was changed");
}

TEST_F(DerivedFolderTest, AFileThatAKilledRunHadBegunIsItsOwnAndMadeAgain) {
  {
    DerivedFolder folder(path_, record_);
    folder.begin("a.pcd");
    write(path_ + "/a.pcd", "points");
  }
  const DerivedFolder folder(path_, record_);
  EXPECT_NO_THROW(folder.requireReplaceable("a.pcd"));
  EXPECT_FALSE(folder.kept("a.pcd", ""));
  EXPECT_FALSE(folder.isOwn("a.pcd"));
}

TEST_F(DerivedFolderTest, ARowThatAKillHasCutIsNeverBelieved) {
  {
    DerivedFolder folder(path_, record_);
    make(folder, "a.pcd", "f1");
    make(folder, "b.pcd", "f2");
  }
  fs::resize_file(record_, fs::file_size(record_) - 2);
  for (int run = 0; run < 2; ++run) {
    const DerivedFolder folder(path_, record_);
    EXPECT_TRUE(folder.kept("a.pcd", "f1"));
    EXPECT_FALSE(folder.kept("b.pcd", "f2"));
    EXPECT_NO_THROW(folder.requireReplaceable("b.pcd"));
  }
  {
    DerivedFolder folder(path_, record_);
    make(folder, "b.pcd", "f2");
  }
  EXPECT_TRUE(DerivedFolder(path_, record_).kept("b.pcd", "f2")) << "a row behind a cut one";
}

TEST_F(DerivedFolderTest, ClearsWhatAKilledRunHasLeftHalfWritten) {
  write(path_ + "/.a.pcd.123-0.tmp", "half");
  const DerivedFolder folder(path_, record_);
  EXPECT_EQ(namesIn(path_), std::set<std::string>{".conversion"});
}

TEST_F(DerivedFolderTest, IsWrittenByOneProcessAtATime) {
  const DerivedFolder first(path_, record_);
  PCRB_EXPECT_ERROR(InvalidFile, DerivedFolder(path_, record_), "another process is writing");
}

class ClaimTest : public testing::Test {
 protected:
  void claim(const std::vector<std::string>& lines, OtherFiles others = OtherFiles::kRefused) {
    claimFolder(folder_, "made_of.txt", lines, others);
  }

  pcrb_test::TemporaryFolder root_;
  const std::string folder_ = root_.file("logs");
};

TEST_F(ClaimTest, OfANewFolderHoldsForTheSameSettings) {
  claim({"seed 1", "size small"});
  write(folder_ + "/log", "data");
  EXPECT_NO_THROW(claim({"seed 1", "size small"}));
  EXPECT_EQ(FileBytes(folder_ + "/made_of.txt").text(), "seed 1\nsize small\n");
}

TEST_F(ClaimTest, OfAFolderWithOtherSettingsNamesEveryDifference) {
  claim({"seed 1", "size small"});
  pcrb_test::expectError<InvalidFile>(
      [&] {
        claim({"seed 2", "size small"});
      },
      "found `seed 1`, asked for `seed 2`");
  pcrb_test::expectError<InvalidFile>([&] { claim({"seed 1"}); },
                                      "found `size small`, asked for nothing");
}

TEST_F(ClaimTest, OfAFolderWithOtherFilesIsRefusedUnlessTheyAreAllowed) {
  write(folder_ + "/real_log", "data");
  PCRB_EXPECT_ERROR(InvalidFile, claim({"seed 1"}), "a folder with other files");
  EXPECT_NO_THROW(claim({"seed 1"}, OtherFiles::kAllowed));
  PCRB_EXPECT_ERROR(InvalidFile,
                    claimFolder(folder_ + "/real_log", "note", {}, OtherFiles::kAllowed),
                    "expected a folder");
}

}  // namespace
}  // namespace pcrb
