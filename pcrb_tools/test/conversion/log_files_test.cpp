#include "conversion/log_files.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "pcrb_core/error.hpp"
#include "support/expect_error.hpp"
#include "support/log_folder.hpp"
#include "support/temporary_folder.hpp"

namespace pcrb_tools {
namespace {

bool none(const LogFile&) { return false; }

std::vector<std::string> namesOf(const LogFiles& files) {
  std::vector<std::string> names;
  for (const auto& file : files.all()) names.push_back(file.name);
  return names;
}

TEST(LogFiles, OfAFolderAreListedInNaturalOrderWithoutHiddenOnes) {
  const pcrb_test::TemporaryFolder folder;
  pcrb_test::writeFiles(folder.path(), {{"g/P10.csv", "10"},
                                        {"g/P2.csv", "2"},
                                        {".g/P3.csv", "3"},
                                        {"g/._P2.csv", "mac"},
                                        {"a.txt", "a"}});
  const LogFiles files({folder.path()}, none);
  EXPECT_EQ(namesOf(files), (std::vector<std::string>{"a.txt", "g/P2.csv", "g/P10.csv"}));
  EXPECT_EQ(files.read(1).text(), "2");
  EXPECT_EQ(files.all()[1].fileName(), "P2.csv");
  EXPECT_EQ(files.all()[1].folder(), "g/");
}

TEST(LogFiles, ArchivesBelowAFolderAndSingleFilesAreRead) {
  const pcrb_test::TemporaryFolder folder;
  pcrb_test::writeFile(folder.file("logs/x.gt"), "pose");
  pcrb_test::writeArchive(folder.file("logs/a.zip"), {{"./s/1.xyz", "one"}, {"s/1.gt", "gt"}});
  pcrb_test::writeFile(folder.file("single.csv"), "single");
  const LogFiles files({folder.file("logs"), folder.file("single.csv")},
                       [](const LogFile& file) { return file.fileName() == "1.gt"; });
  ASSERT_EQ(namesOf(files), (std::vector<std::string>{"x.gt", "", "s/1.xyz", "s/1.gt"}));
  EXPECT_EQ(files.text(3), "gt");
  EXPECT_EQ(files.all()[1].fileName(), "single.csv");
  std::string bytes;
  files.readArchived({2}, [&bytes](std::size_t index, std::string read) {
    EXPECT_EQ(index, 2u);
    bytes = std::move(read);
  });
  EXPECT_EQ(bytes, "one");
}

TEST(LogFiles, WhatIsTooLargeForItsKindIsNotReadFromAnArchive) {
  const pcrb_test::TemporaryFolder folder;
  // Repeated noise compresses to a hundredth, which is not what is refused here.
  const std::string block = pcrb_test::noise(30000);
  std::string bytes;
  while (bytes.size() <= 1U << 24) bytes += block;
  const std::string archive = folder.file("a.zip");
  pcrb_test::writeArchive(
      archive,
      {{"noise", pcrb_test::noise(400000)}, {"VLP_left/1.bin", bytes}, {"VLP_left.csv", bytes}});
  const LogFiles files({archive}, [](const LogFile& file) { return file.name == "VLP_left.csv"; });
  EXPECT_EQ(files.text(2).size(), bytes.size());
  PCRB_EXPECT_ERROR(pcrb::InvalidFile, files.readArchived({1}, [](std::size_t, std::string) {}),
                    "an entry 'VLP_left/1.bin' of more than 16777216 bytes, expected at most that "
                    "much in a file of its kind");
}

TEST(LogFiles, LinksToFoldersAreFollowedButNotInCircles) {
  const pcrb_test::TemporaryFolder folder;
  pcrb_test::writeFiles(folder.path(), {{"log/a.csv", "a"}, {"disk/b.csv", "b"}});
  std::filesystem::create_directory_symlink(folder.file("disk"), folder.file("log/more"));
  std::filesystem::create_directory_symlink(folder.file("log"), folder.file("log/self"));
  EXPECT_EQ(namesOf(LogFiles({folder.file("log")}, none)),
            (std::vector<std::string>{"a.csv", "more/b.csv"}));
}

TEST(LogFiles, WhatIsNotThereOrEmptyOrTwiceIsAnError) {
  const pcrb_test::TemporaryFolder folder;
  PCRB_EXPECT_ERROR(pcrb::InvalidFile, LogFiles({folder.file("no")}, none), "found nothing");
  PCRB_EXPECT_ERROR(pcrb::InvalidFile, LogFiles({folder.path()}, none), "found no file");
  pcrb_test::writeArchive(folder.file("a.tgz"), {{"s/1.xyz", "1"}, {"./s/1.xyz", "2"}});
  PCRB_EXPECT_ERROR(pcrb::InvalidFile, LogFiles({folder.file("a.tgz")}, none),
                    "is in the archive twice");
}

}  // namespace
}  // namespace pcrb_tools
