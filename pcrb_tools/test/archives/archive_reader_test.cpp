#include "archives/archive_reader.hpp"

#include <gtest/gtest.h>
#include <locale.h>

#include <filesystem>

#include "pcrb_core/error.hpp"
#include "support/expect_error.hpp"
#include "support/log_folder.hpp"
#include "support/temporary_folder.hpp"

namespace pcrb_tools {
namespace {

using pcrb_test::NamedFiles;
constexpr std::uint64_t kLimit = 1 << 20;

NamedFiles filesOf(const std::string& path) {
  NamedFiles files;
  ArchiveReader reader(path);
  while (reader.next()) {
    const std::string bytes = reader.read(kLimit);
    files.emplace_back(reader.name(), bytes);
  }
  return files;
}

TEST(ArchiveReader, TakesNamesThatTheLocaleCannotShow) {
  const pcrb_test::TemporaryFolder folder;
  const NamedFiles files{{"a.csv", "1"},
                         {"\xc3\x9c"
                          "bersicht.csv",
                          "2"},
                         {"b.csv", "3"}};
  for (const char* name : {"a.zip", "a.tar.gz"}) {
    const locale_t utf8 = newlocale(LC_CTYPE_MASK, "C.UTF-8", nullptr);
    const locale_t former = uselocale(utf8);
    pcrb_test::writeArchive(folder.file(name), files);
    uselocale(former);
    freelocale(utf8);
    EXPECT_EQ(filesOf(folder.file(name)), files) << name;
  }
}

class EitherArchive : public testing::TestWithParam<const char*> {
 protected:
  std::string write(const NamedFiles& files) const {
    const std::string path = folder_.file(GetParam());
    pcrb_test::writeArchive(path, files);
    return path;
  }

  pcrb_test::TemporaryFolder folder_;
};

TEST_P(EitherArchive, GivesItsFilesInOrder) {
  const NamedFiles files{{"b/2.csv", "two\n"}, {"a.csv", ""}, {"c.bin", std::string(700000, 'x')}};
  EXPECT_EQ(filesOf(write(files)), files);
}

TEST_P(EitherArchive, RefusesNamesThatPointOutOfIt) {
  for (const char* name : {"../a.csv", "b/../../a.csv", "/tmp/a.csv", "a\\..\\b.csv", "a\nb.csv"}) {
    const std::string path = write({{"ok.csv", "1"}, {name, "2"}});
    PCRB_EXPECT_ERROR(pcrb::InvalidFile, filesOf(path),
                      GetParam() + std::string(": found the name"));
  }
}

TEST_P(EitherArchive, RefusesAnEntryThatIsLargerThanTheLimit) {
  const std::string path = write({{"bomb.csv", std::string(kLimit + 1, '\0')}});
  PCRB_EXPECT_ERROR(pcrb::InvalidFile, filesOf(path), "an entry 'bomb.csv' of more than");
}

TEST_P(EitherArchive, RefusesAnEntryThatIsFarLargerThanTheArchive) {
  const std::string path = write({{"bomb.csv", std::string(8 << 20, '\n')}});
  ArchiveReader reader(path);
  ASSERT_TRUE(reader.next());
  PCRB_EXPECT_ERROR(pcrb::InvalidFile, reader.read(1 << 30),
                    "bytes, expected at most 100 times the size of the archive");
  ArchiveReader again(path);
  ASSERT_TRUE(again.next());
  PCRB_EXPECT_ERROR(pcrb::InvalidFile, again.verify(), "an entry 'bomb.csv' of more than");
}

TEST_P(EitherArchive, ACutArchiveIsAnError) {
  const std::string noise = pcrb_test::noise(50000);
  const std::string path = write({{"a.csv", noise}, {"b.csv", noise}});
  std::filesystem::resize_file(path, std::filesystem::file_size(path) / 2);
  PCRB_EXPECT_ERROR(pcrb::InvalidFile, filesOf(path), path);
}

TEST_P(EitherArchive, NamesOutsideAsciiAreRead) {
  const NamedFiles files{{"h\xC3\xBCtte/1.csv", "x"}};
  EXPECT_EQ(filesOf(write(files)), files);
}

INSTANTIATE_TEST_SUITE_P(ArchiveReader, EitherArchive, testing::Values("a.zip", "a.tgz"),
                         [](const auto& given) { return std::string(given.param).substr(2); });

TEST(ArchiveReader, VerifyFindsDamagedBytesThatTheHeadersDoNotShow) {
  const pcrb_test::TemporaryFolder folder;
  const std::string path = folder.file("a.zip");
  pcrb_test::writeArchive(path, {{"a.csv", pcrb_test::noise(5000)}, {"b.csv", "b"}});
  const auto verify = [&] {
    ArchiveReader reader(path);
    while (reader.next()) reader.verify();
  };
  EXPECT_NO_THROW(verify());
  pcrb_test::damage(path, 2000);
  PCRB_EXPECT_ERROR(pcrb::InvalidFile, verify(), "damaged or no archive");
}

TEST(ArchiveReader, NamesWhatIsThereInPlaceOfAnArchive) {
  const pcrb_test::TemporaryFolder folder;
  for (const char* name : {"global_frame.zip", "sequence.tgz"}) {
    const std::string path = folder.file(name);
    const auto expect = [&](const std::string& bytes, const char* message) {
      pcrb_test::writeFile(path, bytes);
      PCRB_EXPECT_ERROR(pcrb::InvalidFile, filesOf(path), message);
    };
    expect("\n<!DOCTYPE html><html><body>Confirm the download</body></html>\n",
           "found an HTML page, expected data");
    expect("<?xml version=\"1.0\"?><Error><Code>AccessDenied</Code></Error>", "a page of XML");
    expect("version https://git-lfs.github.com/spec/v1\noid sha256:4d7a\nsize 1\n",
           "found a Git LFS pointer");
    expect("", "found an empty file");
  }
}

TEST(ArchiveReader, RandomBytesAreNoArchive) {
  const pcrb_test::TemporaryFolder folder;
  pcrb_test::writeFile(folder.file("a.zip"), "this is no archive at all, only some text\n");
  PCRB_EXPECT_ERROR(pcrb::InvalidFile, filesOf(folder.file("a.zip")), "damaged or no archive");
}

TEST(EntryName, IsMadePlain) {
  EXPECT_EQ(requirePlainEntryName("./a//b/./c.csv", "x.zip"), "a/b/c.csv");
  EXPECT_EQ(requirePlainEntryName("a..b/..c", "x.zip"), "a..b/..c");
  for (const char* name : {"", ".", "./", "..", "a/..", "/a"}) {
    EXPECT_THROW(requirePlainEntryName(name, "x.zip"), pcrb::InvalidFile) << name;
  }
}

}  // namespace
}  // namespace pcrb_tools
