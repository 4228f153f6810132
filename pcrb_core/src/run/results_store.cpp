#include "pcrb_core/run/results_store.hpp"

#include <sys/stat.h>

#include <chrono>
#include <filesystem>
#include <optional>
#include <utility>

#include "pcrb_core/error.hpp"
#include "pcrb_core/io/atomic_file.hpp"
#include "pcrb_core/io/csv.hpp"
#include "pcrb_core/io/number.hpp"
#include "pcrb_core/io/text.hpp"
#include "run/sqlite.hpp"
#include "run/store_tables.hpp"

namespace pcrb {
namespace {

/// A folder that is there when this returns.
void makeFolder(const std::string& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw StoreError(folder + ": cannot make this folder: " + error.message());
}

/// The file that a path names, whatever its name becomes; nothing where there is none.
using FileNumber = std::pair<dev_t, ino_t>;

std::optional<FileNumber> fileNumber(const std::string& path) {
  struct stat status {};
  if (stat(path.c_str(), &status) != 0) return std::nullopt;
  return FileNumber{status.st_dev, status.st_ino};
}

std::string csvLine(const Statement& row) {
  std::string line;
  for (int column = 0; column < row.columns(); ++column) {
    if (column > 0) line += ',';
    if (row.type(column) == SQLITE_FLOAT) {
      appendShortest(line, row.real(column));
    } else {
      appendCsvField(line, printableText(row.text(column)));
    }
  }
  return line + '\n';
}

std::string csvHeader() {
  std::string header = kResultColumns;
  for (std::size_t at = header.find(", "); at != std::string::npos; at = header.find(", ", at)) {
    header.erase(at + 1, 1);
  }
  return header + '\n';
}

std::string selectResults() {
  return std::string("SELECT ") + kResultColumns + " FROM result ORDER BY " + kResultOrder;
}

constexpr const char* kUpsertRunInfo =
    "INSERT INTO run (key, value) VALUES (?, ?) "
    "ON CONFLICT (key) DO UPDATE SET value = excluded.value";

}  // namespace

double secondsSinceEpoch() {
  return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
}

/// Members are destroyed from the last: statements, database, lock.
struct ResultsStore::Impl {
  Impl(const std::string& folder, Access access)
      : run_folder(folder),
        lock(access == Access::kReadWrite ? makeLock(folder) : nullptr),
        database(access == Access::kReadWrite ? openStoreForWriting(storePath(folder))
                                              : openStoreForReading(storePath(folder))) {
    if (!lock) return;
    insert_result.emplace(database, insertResultSql(), "add a result");
    insert_scan.emplace(database, insertScanSql(), "add a scan");
    file = fileNumber(database.path());
  }

  /// A file that was removed or replaced takes results all the same, and loses them in the end.
  void requireFileInPlace() const {
    const auto found = fileNumber(database.path());
    if (found && found == file) return;
    throw StoreError(database.path() + ": found " + (found ? "another file" : "no file") +
                     ", expected the one that was opened: the run folder was removed, renamed or "
                     "replaced while the run went on; put it back and start again with the same "
                     "run folder");
  }

  static std::unique_ptr<FileLock> makeLock(const std::string& folder) {
    makeFolder(folder);
    std::unique_ptr<FileLock> lock;
    try {
      lock = std::make_unique<FileLock>(folder + "/results.lock");
    } catch (const InvalidFile& error) {
      throw StoreError(error.what());
    }
    if (lock->isHeld()) return lock;
    throw StoreError(folder + ": found another writer (" + lock->holder() +
                     "), expected none: a run folder takes one at a time");
  }

  static std::string storePath(const std::string& folder) { return folder + "/results.sqlite"; }

  std::string run_folder;
  std::unique_ptr<FileLock> lock;
  Database database;
  std::optional<FileNumber> file;          // that the database is in
  std::optional<Statement> insert_result;  // none where the store is read only
  std::optional<Statement> insert_scan;    // as well
  std::optional<std::int64_t> session;     // row of the session that this object began
};

ResultsStore::ResultsStore(const std::string& run_folder, Access access)
    : impl_(std::make_unique<Impl>(run_folder, access)) {}
ResultsStore::~ResultsStore() = default;
ResultsStore::ResultsStore(ResultsStore&&) noexcept = default;
ResultsStore& ResultsStore::operator=(ResultsStore&&) noexcept = default;

std::string ResultsStore::path() const { return impl_->database.path(); }

std::map<std::string, std::string> ResultsStore::runInfo() const {
  Statement rows(impl_->database, "SELECT key, value FROM run", "read the run table");
  std::map<std::string, std::string> info;
  while (rows.step()) info[rows.text(0)] = rows.text(1);
  return info;
}

void ResultsStore::setRunInfo(const std::map<std::string, std::string>& info) {
  constexpr const char* kAction = "write the run table";
  Transaction transaction(impl_->database, kAction);
  if (impl_->database.value("SELECT count(*) FROM result", kAction) != "0") {
    throw StoreError(path() + ": found results, expected a new store");
  }
  impl_->database.execute("DELETE FROM run", kAction);
  Statement insert(impl_->database, kUpsertRunInfo, kAction);
  for (const auto& [key, value] : info) {
    insert.run([&, &k = key, &v = value](Statement& row) {
      row.bind(k);
      row.bind(v);
    });
  }
  transaction.commit();
}

void ResultsStore::updateRunInfo(const std::string& key, const std::string& value) {
  Statement(impl_->database, kUpsertRunInfo, "write the run table").run([&](Statement& row) {
    row.bind(key);
    row.bind(value);
  });
}

void ResultsStore::beginSession(double started, const std::string& host, int pid) {
  Statement(impl_->database, "INSERT INTO session (started, host, pid) VALUES (?, ?, ?)",
            "note the start of a session")
      .run([&](Statement& row) {
        row.bind(started);
        row.bind(host);
        row.bind(std::int64_t{pid});
      });
  impl_->session = sqlite3_last_insert_rowid(impl_->database.handle());
}

void ResultsStore::endSession(double ended) {
  if (!impl_->session)
    throw StoreError(path() + ": found no session to end, expected beginSession first");
  Statement(impl_->database, "UPDATE session SET ended = ? WHERE rowid = ?",
            "note the end of a session")
      .run([&](Statement& row) {
        row.bind(ended);
        row.bind(*impl_->session);
      });
  impl_->session.reset();
}

std::vector<Session> ResultsStore::sessions() const {
  Statement rows(impl_->database, "SELECT started, ended, host, pid FROM session ORDER BY rowid",
                 "read the sessions");
  std::vector<Session> sessions;
  while (rows.step()) {
    Session session{rows.real(0), std::nullopt, rows.text(2), static_cast<int>(rows.integer(3))};
    if (!rows.isNull(1)) session.ended = rows.real(1);
    sessions.push_back(session);
  }
  return sessions;
}

void ResultsStore::add(const Result& result) { addAll({result}); }

void ResultsStore::addAll(const std::vector<Result>& results) {
  if (!impl_->insert_result) throw StoreError(path() + ": cannot add a result: opened read only");
  Transaction transaction(impl_->database, "add results");
  for (const Result& result : results) {
    insert(result);
    for (const ScanRecord& record : result.scans) {
      impl_->insert_scan->run([&](Statement& row) { bindScan(result.key, record, row); });
    }
  }
  impl_->requireFileInPlace();
  transaction.commit();
}

std::size_t ResultsStore::count() const {
  Statement row(impl_->database, "SELECT count(*) FROM result", "count the results");
  row.step();
  return static_cast<std::size_t>(row.integer(0));
}

std::string ResultsStore::newestSequence() const {
  Statement row(impl_->database, "SELECT sequence FROM result ORDER BY finished DESC LIMIT 1",
                "read the newest result");
  return row.step() ? row.text(0) : "";
}

void ResultsStore::insert(const Result& result) {
  requireStorable(result, path());
  try {
    impl_->insert_result->run([&](Statement& row) { bindResult(result, row); });
  } catch (const StoreError&) {
    const int code = sqlite3_extended_errcode(impl_->database.handle());
    impl_->insert_result->reset();
    if (code != SQLITE_CONSTRAINT_PRIMARYKEY) throw;
    throw StoreError(path() + ": found a result of " + result.key.subject() +
                     ", expected none: every problem has exactly one");
  }
}

std::set<ProblemKey> ResultsStore::finished() const {
  Statement rows(impl_->database, "SELECT data_set, sequence, kind, problem_id FROM result",
                 "read the results");
  std::set<ProblemKey> keys;
  while (rows.step()) keys.insert(readKey(rows, path()));
  return keys;
}

std::vector<Result> ResultsStore::results() const {
  Statement rows(impl_->database, selectResults(), "read the results");
  std::vector<Result> results;
  while (rows.step()) results.push_back(readResult(rows, path()));
  return results;
}

std::map<ProblemKey, std::vector<ScanRecord>> ResultsStore::scans() const {
  std::map<ProblemKey, std::vector<ScanRecord>> scans;
  constexpr const char* kAction = "read the scans";
  if (impl_->database.value("SELECT name FROM sqlite_master WHERE name = 'scan'", kAction)
          .empty()) {
    return scans;  // of an older version
  }
  Statement rows(impl_->database, std::string("SELECT ") + kScanColumns + " FROM scan", kAction);
  while (rows.step()) scans[readKey(rows, path())].push_back(readScan(rows));
  return scans;
}

void ResultsStore::exportCsv() const try {
  Statement rows(impl_->database, selectResults(), "read the results");
  AtomicFile file(impl_->run_folder + "/results.csv");
  file.write(csvHeader());
  while (rows.step()) file.write(csvLine(rows));
  file.commit();
} catch (const InvalidFile& error) {
  throw StoreError(error.what());
}

}  // namespace pcrb
