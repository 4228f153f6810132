#include <unistd.h>

#include <filesystem>

#include "pcrb_core/run/results_store.hpp"
#include "run/store_tables.hpp"

namespace pcrb {
namespace {

constexpr int kCommonFlags = SQLITE_OPEN_NOMUTEX;
constexpr const char* kOpen = "open it";

/// Neither version nor tables: a new file, or one whose writer was killed before the tables were
/// committed.
bool isBlank(Database& database) {
  return database.value("PRAGMA user_version", kOpen) == "0" &&
         database.value("SELECT count(*) FROM sqlite_master", kOpen) == "0";
}

/// Columns of a table in order, separated by `, `.
std::string columnsOf(Database& database, const std::string& table) {
  return database.value(
      "SELECT group_concat(name, ', ') FROM (SELECT name FROM pragma_table_info('" + table +
          "') ORDER BY cid)",
      kOpen);
}

void requireColumns(Database& database, const std::string& table, const std::string& expected) {
  const std::string found = columnsOf(database, table);
  if (found == expected) return;
  throw StoreError(
      database.path() + ": found " +
      (found.empty() ? "no table `" + table + "`" : "table `" + table + "` with columns " + found) +
      ", expected a results store with columns " + expected);
}

bool hasTable(Database& database, const std::string& table) {
  return !columnsOf(database, table).empty();
}

/// That this is a results store of this version, and intact.
void requireStore(Database& database) {
  const std::string version = database.value("PRAGMA user_version", kOpen);
  if (version != "1") {
    throw StoreError(database.path() + ": found user_version " + version +
                     ", expected 1: another program's database, or another version's store");
  }
  requireColumns(database, "run", "key, value");
  requireColumns(database, "session", "started, ended, host, pid");
  requireColumns(database, "result", kResultColumns);
  if (hasTable(database, "scan")) requireColumns(database, "scan", kScanColumns);
  const std::string check = database.value("PRAGMA quick_check(1)", "check its integrity");
  if (check != "ok") {
    throw StoreError(database.path() + ": found a damaged database (" + check +
                     "), expected an intact one");
  }
}

/// Every commit is on the disk when it returns: write-ahead log, fsync per commit.
void requireDurability(Database& database) {
  const std::string mode = database.value("PRAGMA journal_mode = WAL", "use a write-ahead log");
  if (mode != "wal") {
    throw StoreError(database.path() + ": found journal mode `" + mode +
                     "`, expected `wal`: does this file system lack shared memory?");
  }
  database.execute("PRAGMA synchronous = FULL", "set synchronous commits");
}

void makeTables(Database& database) {
  Transaction transaction(database, "make the tables");
  database.execute(kResultsSchema, "make the tables");
  database.execute("PRAGMA user_version = 1", "make the tables");
  transaction.commit();
}

/// `file:` URI of a database that nobody changes while it is open; then no shared memory is needed.
std::string immutableUri(const std::string& path) {
  constexpr char kHex[] = "0123456789ABCDEF";
  std::string uri = "file:";
  for (const char character : std::filesystem::absolute(path).string()) {
    const auto byte = static_cast<unsigned char>(character);
    if (character == '%' || character == '?' || character == '#') {
      uri += {'%', kHex[byte >> 4], kHex[byte & 15]};
    } else {
      uri += character;
    }
  }
  return uri + "?immutable=1";
}

/// Whether a store lies where no write-ahead log can be made, and has none: on a read-only disk, in
/// somebody else's folder.
bool isArchived(const std::string& path) {
  const std::string folder = std::filesystem::path(path).parent_path().string();
  return access(folder.empty() ? "." : folder.c_str(), W_OK) != 0 &&
         !std::filesystem::exists(path + "-wal");
}

}  // namespace

Database openStoreForWriting(const std::string& path) {
  Database database(path, kCommonFlags | SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE);
  const bool blank = isBlank(database);
  if (!blank) requireStore(database);
  requireDurability(database);
  if (blank) makeTables(database);
  database.execute(kScanSchema, "make the table of scans");
  return database;
}

Database openStoreForReading(const std::string& path) {
  if (!std::filesystem::exists(path)) {
    throw StoreError(path + ": found no file, expected the results of a run");
  }
  constexpr int kFlags = kCommonFlags | SQLITE_OPEN_READONLY;
  Database database = isArchived(path)
                          ? Database(path, kFlags | SQLITE_OPEN_URI, immutableUri(path))
                          : Database(path, kFlags);
  if (isBlank(database)) {
    throw StoreError(path + ": found an empty database, expected the results of a run");
  }
  requireStore(database);
  return database;
}

}  // namespace pcrb
