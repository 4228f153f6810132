#include "pcrb_core/io/file_bytes.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>

#include "pcrb_core/error.hpp"
#include "pcrb_core/io/atomic_file.hpp"
#include "support/temporary_folder.hpp"

namespace pcrb {
namespace {

std::string messageOf(const std::string& path) {
  try {
    FileBytes file(path);
  } catch (const InvalidFile& error) {
    return error.what();
  }
  return "no error";
}

TEST(FileBytes, HoldsTheFile) {
  const pcrb_test::TemporaryFolder folder;
  const std::string content("a\0b\n", 4);
  writeFileAtomically(folder.file("a"), content);
  EXPECT_EQ(FileBytes(folder.file("a")).text(), content);
}

TEST(FileBytes, AnEmptyFileIsEmpty) {
  const pcrb_test::TemporaryFolder folder;
  writeFileAtomically(folder.file("a"), "");
  EXPECT_EQ(FileBytes(folder.file("a")).size(), 0u);
}

TEST(FileBytes, RejectsWhatIsNoRegularFile) {
  const pcrb_test::TemporaryFolder folder;
  const std::string fifo = folder.file("fifo");
  ASSERT_EQ(mkfifo(fifo.c_str(), 0600), 0);
  EXPECT_EQ(messageOf(folder.file("none")),
            folder.file("none") + ": cannot open: No such file or directory");
  EXPECT_EQ(messageOf(folder.path()), folder.path() + ": found a folder, expected a regular file");
  EXPECT_EQ(messageOf(fifo), fifo + ": found a special file, expected a regular file");
}

}  // namespace
}  // namespace pcrb

namespace {

// Test vector of FIPS 180-2, appendix B.1.
TEST(FileHash, Sha256IsThatOfTheStandard) {
  const pcrb_test::TemporaryFolder folder;
  std::ofstream(folder.file("abc")) << "abc";
  EXPECT_EQ(pcrb::fileSha256(folder.file("abc")),
            "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

TEST(FileHash, DependsOnEveryBlockOfTheFile) {
  const pcrb_test::TemporaryFolder folder;
  std::string bytes(3 << 20, 'a');
  std::ofstream(folder.file("a")) << bytes;
  bytes[1 << 20] = 'b';
  std::ofstream(folder.file("b")) << bytes;
  for (const auto hash : {pcrb::fileHash, pcrb::fileSha256}) {
    EXPECT_NE(hash(folder.file("a")), hash(folder.file("b")));
    EXPECT_EQ(hash(folder.file("a")).size(), 64U);
    EXPECT_THROW(hash(folder.file("absent")), pcrb::InvalidFile);
  }
}

}  // namespace
