#include "run/sqlite.hpp"

#include <cstring>
#include <utility>

#include "pcrb_core/run/results_store.hpp"

namespace pcrb {

namespace {

/// What is said of failures that have to do with locks: SQLite's own words name no cause.
const char* causeOfLockFailure(int extended_code) {
  switch (extended_code) {
    case SQLITE_IOERR_LOCK:
    case SQLITE_IOERR_RDLOCK:
    case SQLITE_IOERR_UNLOCK:
    case SQLITE_IOERR_CHECKRESERVEDLOCK:
    case SQLITE_IOERR_SHMLOCK:
    case SQLITE_IOERR_SHMMAP:
    case SQLITE_IOERR_SHMOPEN:
    case SQLITE_IOERR_SHMSIZE:
      return ": its file system refuses locks or shared memory, as NFS may: put the run's folder "
             "on a local disk";
    default:
      break;
  }
  const int code = extended_code & 0xff;
  if (code != SQLITE_BUSY && code != SQLITE_PROTOCOL) return "";
  return ": another program holds it, or its file system refuses locks, as NFS may: end that "
         "program, or put the run's folder on a local disk";
}

}  // namespace

Database::Database(const std::string& path, int flags, const std::string& uri) : path_(path) {
  constexpr int kBusyTimeoutMs = 5000;     // somebody looks into the store with another program
  constexpr int kLongestValue = 64 << 20;  // bytes, far above all that a run has
  sqlite3* handle = nullptr;
  const std::string& name = uri.empty() ? path : uri;
  const int code = sqlite3_open_v2(name.c_str(), &handle, flags, nullptr);
  handle_.reset(handle);
  if (handle == nullptr) throw StoreError(path + ": cannot open it: out of memory");
  if (code != SQLITE_OK) fail("open it");
  sqlite3_extended_result_codes(handle, 1);
  sqlite3_busy_timeout(handle, kBusyTimeoutMs);
  sqlite3_limit(handle, SQLITE_LIMIT_LENGTH, kLongestValue);
}

void Database::execute(const char* sql, const char* action) {
  if (sqlite3_exec(handle(), sql, nullptr, nullptr, nullptr) != SQLITE_OK) fail(action);
}

std::string Database::value(const std::string& sql, const char* action) {
  Statement statement(*this, sql, action);
  return statement.step() ? statement.text(0) : std::string();
}

void Database::fail(const std::string& action) const {
  std::string message = path_ + ": cannot " + action + ": " + sqlite3_errmsg(handle());
  const int system_error = sqlite3_system_errno(handle());
  const int code = sqlite3_errcode(handle());
  if (system_error != 0 && (code == SQLITE_IOERR || code == SQLITE_CANTOPEN)) {
    message += std::string(" (") + std::strerror(system_error) + ")";
  }
  throw StoreError(message + causeOfLockFailure(sqlite3_extended_errcode(handle())));
}

Statement::Statement(Database& database, const std::string& sql, std::string action)
    : database_(&database), action_(std::move(action)) {
  sqlite3_stmt* handle = nullptr;
  const int code = sqlite3_prepare_v2(database.handle(), sql.data(), static_cast<int>(sql.size()),
                                      &handle, nullptr);
  handle_.reset(handle);
  check(code);
}

void Statement::reset() {
  sqlite3_reset(handle_.get());  // repeats the code of a failure that step() has thrown already
  sqlite3_clear_bindings(handle_.get());
  next_parameter_ = 1;
}

void Statement::bind(std::string_view text) {
  check(sqlite3_bind_text64(handle_.get(), next_parameter_++, text.data(), text.size(),
                            SQLITE_TRANSIENT, SQLITE_UTF8));
}

void Statement::bind(double value) {
  check(sqlite3_bind_double(handle_.get(), next_parameter_++, value));
}

void Statement::bind(std::int64_t value) {
  check(sqlite3_bind_int64(handle_.get(), next_parameter_++, value));
}

void Statement::bindNull() { check(sqlite3_bind_null(handle_.get(), next_parameter_++)); }

bool Statement::step() {
  const int code = sqlite3_step(handle_.get());
  if (code == SQLITE_ROW) return true;
  if (code != SQLITE_DONE) check(code);
  return false;
}

std::string Statement::text(int column) const {
  const auto* bytes = sqlite3_column_text(handle_.get(), column);
  if (bytes == nullptr) return {};
  return {reinterpret_cast<const char*>(bytes),
          static_cast<std::size_t>(sqlite3_column_bytes(handle_.get(), column))};
}

void Statement::check(int code) const {
  if (code != SQLITE_OK) database_->fail(action_);
}

Transaction::Transaction(Database& database, const char* action)
    : database_(database), action_(action) {
  database.execute("BEGIN IMMEDIATE", action);
}

Transaction::~Transaction() {
  if (open_) sqlite3_exec(database_.handle(), "ROLLBACK", nullptr, nullptr, nullptr);
}

void Transaction::commit() {
  database_.execute("COMMIT", action_);
  open_ = false;
}

}  // namespace pcrb
