#include "pcrb_core/io/atomic_file.hpp"

#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "pcrb_core/error.hpp"
#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"

namespace {

bool is_lock_refused = false;

}  // namespace

/// In place of the C library's: a file system without a lock service, where a test wants one.
extern "C" int flock(int descriptor, int operation) {
  if (!is_lock_refused) return static_cast<int>(syscall(SYS_flock, descriptor, operation));
  errno = ENOLCK;
  return -1;
}

namespace pcrb {
namespace {

namespace fs = std::filesystem;

std::string contentOf(const std::string& path) {
  std::ostringstream content;
  content << std::ifstream(path, std::ios::binary).rdbuf();
  return content.str();
}

std::size_t entriesIn(const std::string& folder) {
  return static_cast<std::size_t>(
      std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

/// Lets this process write files of at most `bytes` bytes while it lives.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;

 private:
  rlimit before_{};
  void (*handler_)(int);
};

TEST(AtomicFile, AppearsWithItsWholeContentOnCommitOnly) {
  const pcrb_test::TemporaryFolder folder;
  const std::string path = folder.file("a.txt");
  const std::string large(1000000, 'x');
  AtomicFile file(path);
  file.write("head\n");
  file.write(large);
  EXPECT_FALSE(fs::exists(path));
  file.commit();
  EXPECT_EQ(contentOf(path), "head\n" + large);
  EXPECT_EQ(entriesIn(folder.path()), 1u);
}

TEST(AtomicFile, WithoutCommitTheOldFileStaysAndNothingElse) {
  const pcrb_test::TemporaryFolder folder;
  const std::string path = folder.file("a.txt");
  writeFileAtomically(path, "old");
  { AtomicFile(path).write(std::string(1000000, 'x')); }
  EXPECT_EQ(contentOf(path), "old");
  EXPECT_EQ(entriesIn(folder.path()), 1u);
}

TEST(AtomicFile, FailedWriteNamesTheFileAndLeavesNothing) {
  const pcrb_test::TemporaryFolder folder;
  const std::string path = folder.file("a.txt");
  const FileSizeLimit limit(4096);
  try {
    writeFileAtomically(path, std::string(1000000, 'x'));
    FAIL() << "wrote more than the limit";
  } catch (const InvalidFile& error) {
    EXPECT_EQ(std::string(error.what()), path + ": cannot write: File too large");
  }
  EXPECT_EQ(entriesIn(folder.path()), 0u);
}

TEST(AtomicFile, RejectsAFolderThatDoesNotExist) {
  const pcrb_test::TemporaryFolder folder;
  EXPECT_THROW(AtomicFile(folder.file("none/a.txt")), InvalidFile);
}

TEST(AtomicFile, RejectsFoldersAndSpecialFilesAsTargets) {
  const pcrb_test::TemporaryFolder folder;
  EXPECT_THROW(AtomicFile{folder.path()}, InvalidFile);
  EXPECT_THROW(AtomicFile{"/dev/null"}, InvalidFile);
}

TEST(AtomicFile, FollowsALinkInsteadOfReplacingIt) {
  const pcrb_test::TemporaryFolder folder;
  writeFileAtomically(folder.file("real"), "old");
  fs::create_symlink("real", folder.file("link"));
  writeFileAtomically(folder.file("link"), "new");
  EXPECT_TRUE(fs::is_symlink(folder.file("link")));
  EXPECT_EQ(contentOf(folder.file("real")), "new");
}

TEST(AtomicFile, GetsTheModeThatTheUmaskGives) {
  const pcrb_test::TemporaryFolder folder;
  const mode_t before = umask(022);
  writeFileAtomically(folder.file("a"), "");
  umask(before);
  EXPECT_EQ(fs::status(folder.file("a")).permissions(), static_cast<fs::perms>(0644));
}

TEST(FileLock, IsHeldByOneAtATimeAndNamesItToOthers) {
  const pcrb_test::TemporaryFolder folder;
  const std::string path = folder.file("a.lock");
  {
    const FileLock first(path);
    EXPECT_TRUE(first.isHeld());
    EXPECT_EQ(first.holder(), "");
    const FileLock second(path);
    EXPECT_FALSE(second.isHeld());
    EXPECT_EQ(second.holder().find("process " + std::to_string(getpid()) + " on "), 0U);
  }
  EXPECT_TRUE(FileLock(path).isHeld());
}

TEST(FileLock, NamesTheFileSystemThatRefusesLocksAndTheRemedy) {
  const pcrb_test::TemporaryFolder folder;
  is_lock_refused = true;
  pcrb_test::expectError<InvalidFile>([&] { const FileLock lock(folder.file("a.lock")); },
                                      folder.file("a.lock"), "its file system refuse locks",
                                      "on a local disk");
  is_lock_refused = false;
}

TEST(FileLock, RefusesAFileThatCannotBeMade) {
  EXPECT_THROW(FileLock("/no/such/folder/a.lock"), InvalidFile);
}

}  // namespace
}  // namespace pcrb
