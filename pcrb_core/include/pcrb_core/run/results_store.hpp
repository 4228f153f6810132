#pragma once

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "pcrb_core/error.hpp"
#include "pcrb_core/run/result.hpp"

namespace pcrb {

/// A results store that cannot be opened, read or written, or does not fit what is asked of it.
class StoreError : public Error {
 public:
  using Error::Error;
};

/// Now, as the store has it: s since the epoch.
double secondsSinceEpoch();

/// One start of the server.
struct Session {
  double started = 0.0;         ///< s since the epoch
  std::optional<double> ended;  ///< s since the epoch; none after a kill
  std::string host;
  int pid = 0;
};

/// The results of one run: `<run>/results.sqlite` (WAL, synchronous FULL, `user_version` 1).
///
/// Every add() is committed and on disk when it returns (one fsync). Killed at any moment, the
/// store keeps all that was added; a failed add() adds nothing and may be tried again. Not
/// thread-safe. One writer per run folder, held off by a kernel lock on `results.lock`, which a
/// kill frees; any number of readers beside it.
class ResultsStore {
 public:
  enum class Access { kReadOnly, kReadWrite };

  /// Opens the store of a run folder; with kReadWrite folder and store are made where missing. Its
  /// tables and integrity are checked. A reader needs no write permission, as long as a writer is
  /// active or ended well.
  ///
  /// @throws StoreError  naming the file: not a database, another `user_version` or other tables,
  ///                     damaged, held by another writer (which is named), missing (read-only),
  ///                     permissions, full disk.
  ResultsStore(const std::string& run_folder, Access access);
  ~ResultsStore();
  ResultsStore(ResultsStore&&) noexcept;
  ResultsStore& operator=(ResultsStore&&) noexcept;

  /// The run table. Empty for a new store.
  std::map<std::string, std::string> runInfo() const;

  /// Writes the run table of a store without results anew, in one transaction.
  /// @throws StoreError  if the store has results already.
  void setRunInfo(const std::map<std::string, std::string>& info);

  /// Adds or replaces one value of the run table: for what is only known later.
  void updateRunInfo(const std::string& key, const std::string& value);

  /// Notes a start of the server; the session ends with endSession or stays open after a kill.
  void beginSession(double started, const std::string& host, int pid);
  void endSession(double ended);

  /// All sessions, in the order in which they began.
  std::vector<Session> sessions() const;

  /// Commits one result and its scans. The covariance is stored as text: 36 numbers in their
  /// shortest exact form, separated by spaces; its entries need not be finite.
  ///
  /// @throws StoreError  if the problem has a result already; if a number is negative, not finite
  ///                     or out of its range, or the pose is incomplete; on any failure to write;
  ///                     if the database is no longer the file in the run folder.
  void add(const Result& result);

  /// Commits many results at once: all or, on any failure, none. As add() otherwise.
  void addAll(const std::vector<Result>& results);

  /// Number of stored results.
  std::size_t count() const;

  /// Sequence of the result that was stored last; empty where there is none.
  std::string newestSequence() const;

  /// Keys of all stored results.
  std::set<ProblemKey> finished() const;

  /// All results, ordered by data set, sequence, kind, problem id; without their scans.
  std::vector<Result> results() const;

  /// Scans of all results that have any, in order.
  std::map<ProblemKey, std::vector<ScanRecord>> scans() const;

  /// Writes `results.csv` (all columns of the result table, in the order of results(), NULL as
  /// empty field, quoted as in RFC 4180) beside the store, to a temporary name, then renames.
  void exportCsv() const;

  std::string path() const;  ///< of the database file

 private:
  struct Impl;

  void insert(const Result& result);

  std::unique_ptr<Impl> impl_;
};

}  // namespace pcrb
