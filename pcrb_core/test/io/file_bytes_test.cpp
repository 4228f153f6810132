#include "pcrb_core/io/file_bytes.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

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
