// What a results store keeps when its writer is killed, its disk is full or its folder is read
// only. The writers are child processes.

#include <gtest/gtest.h>
#include <sched.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <functional>

#include "pcrb_core/random.hpp"
#include "pcrb_core/run/results_store.hpp"
#include "run/some_results.hpp"
#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"

namespace pcrb {
namespace {

using pcrb_test::fullResult;
using Access = ResultsStore::Access;

constexpr int kPassed = 0;
constexpr int kFailed = 1;
constexpr int kSkipped = 77;

/// A child process that runs a function and reports whole numbers through a pipe.
class Child {
 public:
  using Report = std::function<void(int)>;

  /// @param body  its value is the exit status; an exception's text goes to stderr, status 1.
  explicit Child(const std::function<int(const Report&)>& body) {
    if (pipe(pipe_) != 0) throw std::runtime_error("pipe failed");
    pid_ = fork();
    if (pid_ < 0) throw std::runtime_error("fork failed");
    if (pid_ == 0) _exit(run(body));
    close(pipe_[1]);
  }
  ~Child() { close(pipe_[0]); }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  /// The next number that the child reports; nothing when it is gone.
  std::optional<int> next() const {
    int value = 0;
    if (read(pipe_[0], &value, sizeof(value)) != sizeof(value)) return std::nullopt;
    return value;
  }

  void kill() const { ::kill(pid_, SIGKILL); }

  int wait() const {
    int status = 0;
    waitpid(pid_, &status, 0);
    return status;
  }

 private:
  int run(const std::function<int(const Report&)>& body) const try {
    return body([this](int value) {
      if (write(pipe_[1], &value, sizeof(value)) != sizeof(value)) _exit(kFailed);
    });
  } catch (const std::exception& error) {
    fprintf(stderr, "child: %s\n", error.what());
    return kFailed;
  }

  int pipe_[2] = {-1, -1};
  pid_t pid_ = -1;
};

Result numberedResult(int number) { return fullResult(std::to_string(1000000 + number)); }

/// Adds results from `number` on and reports each when add() has returned.
void addForEver(ResultsStore& store, int number, const Child::Report& report) {
  for (;; ++number) {
    store.add(numberedResult(number));
    report(number);
  }
}

/// Opens the store anew and checks that it holds the results 0 … count − 1 and nothing else, where
/// count is at least `reported`.
int requireFirst(const std::string& run, int reported) {
  const auto results = ResultsStore(run, Access::kReadOnly).results();
  const int count = static_cast<int>(results.size());
  EXPECT_GE(count, reported);
  for (int i = 0; i < count; ++i) {
    EXPECT_EQ(results[static_cast<std::size_t>(i)].key, numberedResult(i).key);
    EXPECT_EQ(results[static_cast<std::size_t>(i)].covariance, numberedResult(i).covariance);
  }
  return count;
}

/// Starts a writer, kills it at a random moment and checks what it leaves to the next.
///
/// @param count  results in the store before; returns how many are there after.
int killWriter(const std::string& run, int count, Random& random) {
  const Child child([&](const Child::Report& report) {
    ResultsStore store(run, Access::kReadWrite);
    addForEver(store, static_cast<int>(store.finished().size()), report);
    return kPassed;
  });
  for (std::uint64_t reports = random.below(8); reports > 0; --reports) {
    count = child.next().value() + 1;
  }
  // Spin into the middle of what the child does: it opens the store or adds a result.
  for (volatile std::uint64_t spin = random.below(20000000); spin > 0; spin = spin - 1) {
  }
  child.kill();
  while (const auto number = child.next()) count = *number + 1;
  EXPECT_TRUE(WIFSIGNALED(child.wait()));
  const ResultsStore next(run, Access::kReadWrite);  // recovers; no lock is left behind
  EXPECT_LE(static_cast<int>(next.finished().size()), count + 1);
  return requireFirst(run, count);
}

TEST(ResultsStoreSurvival, KeepsWhatAddReturnedForWhenItsWriterIsKilledAtAnyMoment) {
  const pcrb_test::TemporaryFolder folder;
  Random random(1);
  for (int run = 0; run < 10; ++run) {
    int count = 0;
    for (int kill = 0; kill < 4; ++kill) {
      count = killWriter(folder.file(std::to_string(run)), count, random);
    }
  }
}

/// Adds results until the disk is full, then sees that the store is whole, and goes on when there
/// is room again.
int fillDisk(const std::string& run, const std::function<void()>& make_room,
             const Child::Report& report) {
  ResultsStore store(run, Access::kReadWrite);
  try {
    addForEver(store, 0, report);
  } catch (const StoreError& error) {
    if (std::string(error.what()).find(store.path()) == std::string::npos) return kFailed;
  }
  const int count = static_cast<int>(store.finished().size());
  make_room();
  store.add(numberedResult(count));
  report(count);
  return requireFirst(run, count + 1) == count + 1 ? kPassed : kFailed;
}

TEST(ResultsStoreSurvival, LosesNothingWhenAFileCannotGrow) {
  const pcrb_test::TemporaryFolder folder;
  const Child child([&](const Child::Report& report) {
    signal(SIGXFSZ, SIG_IGN);
    rlimit limit{};
    getrlimit(RLIMIT_FSIZE, &limit);
    const rlimit small{300000, limit.rlim_max};
    setrlimit(RLIMIT_FSIZE, &small);
    return fillDisk(
        folder.path(), [&] { setrlimit(RLIMIT_FSIZE, &limit); }, report);
  });
  int reported = 0;
  while (const auto number = child.next()) reported = *number + 1;
  EXPECT_EQ(WEXITSTATUS(child.wait()), kPassed);
  EXPECT_GT(reported, 10);
  EXPECT_EQ(requireFirst(folder.path(), reported), reported);
}

TEST(ResultsStoreSurvival, LosesNothingWhenTheDiskIsFull) {
  const pcrb_test::TemporaryFolder folder;
  const Child child([&](const Child::Report& report) {
    // A small disk that nobody else sees and that goes away with the child.
    if (unshare(CLONE_NEWNS) != 0 ||
        mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) != 0 ||
        mount("none", folder.path().c_str(), "tmpfs", 0, "size=300k") != 0) {
      return kSkipped;
    }
    const auto make_room = [&] {
      mount("none", folder.path().c_str(), "tmpfs", MS_REMOUNT, "size=3m");
    };
    return fillDisk(folder.path(), make_room, report);
  });
  while (child.next()) {
  }
  const int status = WEXITSTATUS(child.wait());
  if (status == kSkipped) GTEST_SKIP() << "cannot mount a small disk here (needs root)";
  EXPECT_EQ(status, kPassed);
}

/// Reads a store as somebody who must not write into its folder.
int countAsStranger(const std::string& run) {
  chmod(run.c_str(), 0555);
  const Child child([&](const Child::Report& report) {
    constexpr uid_t kNobody = 65534;
    if (getuid() == 0 && setresuid(kNobody, kNobody, kNobody) != 0) return kFailed;
    if (access(run.c_str(), W_OK) == 0) return kFailed;
    report(static_cast<int>(ResultsStore(run, Access::kReadOnly).results().size()));
    return kPassed;
  });
  const int count = child.next().value_or(-1);
  EXPECT_EQ(child.wait(), 0);
  chmod(run.c_str(), 0755);
  return count;
}

TEST(ResultsStoreSurvival, IsReadInAFolderWithoutWritePermission) {
  const pcrb_test::TemporaryFolder folder;
  ResultsStore(folder.path(), Access::kReadWrite).add(numberedResult(0));
  EXPECT_EQ(countAsStranger(folder.path()), 1);
}

TEST(ResultsStoreSurvival, NoticesAtTheNextResultThatItsFolderIsGoneOrAnother) {
  const pcrb_test::TemporaryFolder folder;
  const std::string run = folder.file("run"), moved = folder.file("moved");
  ResultsStore store(run, Access::kReadWrite);
  store.add(numberedResult(0));
  std::filesystem::rename(run, moved);
  pcrb_test::expectError<StoreError>([&] { store.add(numberedResult(1)); }, "results.sqlite",
                                     "found no file, expected the one that was opened");
  { const ResultsStore other(run, Access::kReadWrite); }
  pcrb_test::expectError<StoreError>([&] { store.add(numberedResult(2)); }, "found another file");
  std::filesystem::remove_all(run);
  std::filesystem::rename(moved, run);
  store.add(numberedResult(3));
}

TEST(ResultsStoreSurvival, IsReadBySomebodyElseWhileItsWriterIsActive) {
  const pcrb_test::TemporaryFolder folder;
  ResultsStore store(folder.path(), Access::kReadWrite);
  store.add(numberedResult(0));
  store.add(numberedResult(1));
  EXPECT_EQ(countAsStranger(folder.path()), 2);
}

TEST(ResultsStoreSurvival, IsReadAfterItsWriterWasKilledBeforeAnyoneElseWrites) {
  const pcrb_test::TemporaryFolder folder;
  const Child child([&](const Child::Report& report) {
    ResultsStore store(folder.path(), Access::kReadWrite);
    addForEver(store, 0, report);
    return kPassed;
  });
  ASSERT_TRUE(child.next());
  child.kill();
  child.wait();
  EXPECT_GE(requireFirst(folder.path(), 1), 1);
}

}  // namespace
}  // namespace pcrb
