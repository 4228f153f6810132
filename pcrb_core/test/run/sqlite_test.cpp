#include "run/sqlite.hpp"

#include <gtest/gtest.h>

#include <cerrno>

#include "pcrb_core/run/results_store.hpp"
#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"

namespace pcrb {
namespace {

using pcrb_test::expectError;

constexpr int kFlags = SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE;
constexpr const char* kCause = "its file system refuses locks, as NFS may";
constexpr const char* kRemedy = "put the run's folder on a local disk";

/// A connection that does not wait for others.
Database impatient(const std::string& path) {
  Database database(path, kFlags);
  sqlite3_busy_timeout(database.handle(), 0);
  return database;
}

/// fcntl of a file system without a lock service.
int refuseLocks(int /*descriptor*/, int /*command*/, ...) {
  errno = ENOLCK;
  return -1;
}

/// Replaces a system call of SQLite while it lives.
class SystemCall {
 public:
  explicit SystemCall(sqlite3_syscall_ptr call) { vfs_->xSetSystemCall(vfs_, "fcntl", call); }
  ~SystemCall() { vfs_->xSetSystemCall(vfs_, "fcntl", nullptr); }
  SystemCall(const SystemCall&) = delete;
  SystemCall& operator=(const SystemCall&) = delete;

 private:
  sqlite3_vfs* vfs_ = sqlite3_vfs_find(nullptr);
};

TEST(Database, SaysThatAnotherProgramHoldsIt) {
  const pcrb_test::TemporaryFolder folder;
  const std::string path = folder.file("a.sqlite");
  Database first(path, kFlags);
  first.execute("BEGIN EXCLUSIVE", "begin");
  Database second = impatient(path);
  expectError<StoreError>([&] { second.execute("BEGIN IMMEDIATE", "add a result"); },
                          path + ": cannot add a result: database is locked",
                          "another program holds it", kCause, kRemedy);
}

TEST(Database, NamesTheFileSystemThatRefusesLocksAndTheRemedy) {
  const pcrb_test::TemporaryFolder folder;
  Database database = impatient(folder.file("a.sqlite"));
  const SystemCall refusing(reinterpret_cast<sqlite3_syscall_ptr>(refuseLocks));
  expectError<StoreError>([&] { database.execute("CREATE TABLE t (a)", "make the tables"); },
                          "cannot make the tables", kCause, kRemedy);
}

TEST(Database, SaysNothingOfLocksWhereAFailureHasAnotherCause) {
  const pcrb_test::TemporaryFolder folder;
  Database database = impatient(folder.file("a.sqlite"));
  try {
    database.execute("SELECT nothing", "look");
    ADD_FAILURE() << "nothing was thrown";
  } catch (const StoreError& error) {
    EXPECT_EQ(std::string(error.what()).find("locks"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace pcrb
