#include "pcrb_core/run/results_store.hpp"

#include <gtest/gtest.h>
#include <sqlite3.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>

#include "run/some_results.hpp"
#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"

namespace pcrb {
namespace {

using pcrb_test::expectError;
using pcrb_test::fullResult;
using pcrb_test::minimalResult;
using Access = ResultsStore::Access;

/// Runs SQL as any other program would.
void runSql(const std::string& path, const char* sql) {
  sqlite3* handle = nullptr;
  ASSERT_EQ(sqlite3_open(path.c_str(), &handle), SQLITE_OK);
  EXPECT_EQ(sqlite3_exec(handle, sql, nullptr, nullptr, nullptr), SQLITE_OK)
      << sqlite3_errmsg(handle);
  sqlite3_close(handle);
}

std::string readFile(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

void expectEqual(const Result& a, const Result& b) {
  EXPECT_EQ(a.key, b.key);
  EXPECT_EQ(a.source, b.source);
  EXPECT_EQ(a.target, b.target);
  EXPECT_EQ(a.overlap, b.overlap);
  EXPECT_EQ(a.outcome, b.outcome);
  EXPECT_EQ(a.reason, b.reason);
  EXPECT_EQ(a.error, b.error);
  EXPECT_EQ(a.initial_misalignment, b.initial_misalignment);
  EXPECT_EQ(a.rotation_error, b.rotation_error);
  EXPECT_EQ(a.translation_error, b.translation_error);
  EXPECT_EQ(a.runtime, b.runtime);
  EXPECT_EQ(a.solver_time, b.solver_time);
  EXPECT_EQ(a.scans_used, b.scans_used);
  EXPECT_EQ(a.target_changed, b.target_changed);
  EXPECT_EQ(a.replies_rejected, b.replies_rejected);
  EXPECT_EQ(a.position, b.position);
  ASSERT_EQ(a.orientation.has_value(), b.orientation.has_value());
  if (a.orientation) {
    EXPECT_EQ(a.orientation->coeffs(), b.orientation->coeffs());
  }
  EXPECT_EQ(a.covariance, b.covariance);
  EXPECT_EQ(a.finished, b.finished);
}

class ResultsStoreTest : public ::testing::Test {
 protected:
  ResultsStore writer() const { return ResultsStore(run(), Access::kReadWrite); }
  ResultsStore reader() const { return ResultsStore(run(), Access::kReadOnly); }
  std::string run() const { return folder_.file("runs/first"); }
  std::string database() const { return run() + "/results.sqlite"; }

  /// A run folder whose database has these bytes.
  void makeDatabase(const std::string& bytes) const {
    std::filesystem::create_directories(run());
    std::ofstream(database(), std::ios::binary) << bytes;
  }

  pcrb_test::TemporaryFolder folder_;
};

TEST_F(ResultsStoreTest, GivesBackWhatWasAddedToTheLastBit) {
  const Result full = fullResult("1");
  const Result minimal = minimalResult("2");
  {
    ResultsStore store = writer();
    store.add(minimal);
    store.add(full);
  }
  const auto results = reader().results();
  ASSERT_EQ(results.size(), 2u);
  expectEqual(results[0], full);
  expectEqual(results[1], minimal);
}

TEST_F(ResultsStoreTest, ListsResultsInTheOrderOfTheirKeys) {
  ResultsStore store = writer();
  for (const Kind kind : {Kind::kGlobal, Kind::kLocal}) {
    for (const char* id : {"2", "1"}) {
      Result result = minimalResult(id);
      result.key.kind = kind;
      store.add(result);
    }
  }
  const auto keys = store.finished();
  std::vector<ProblemKey> listed;
  for (const Result& result : store.results()) listed.push_back(result.key);
  EXPECT_EQ(listed, std::vector<ProblemKey>(keys.begin(), keys.end()));
  EXPECT_EQ(listed.front().kind, Kind::kLocal);
}

TEST_F(ResultsStoreTest, RefusesASecondResultOfAProblemAndKeepsTheFirst) {
  ResultsStore store = writer();
  Result result = minimalResult("1");
  store.add(result);
  result.error = 99.0;
  expectError<StoreError>([&] { store.add(result); }, database(), "eth/plain local 1",
                          "exactly one");
  store.add(minimalResult("2"));
  ASSERT_EQ(store.results().size(), 2u);
  EXPECT_EQ(store.results()[0].error, minimalResult("1").error);
}

TEST_F(ResultsStoreTest, RefusesNumbersThatAreNotFiniteOrOutOfRange) {
  ResultsStore store = writer();
  Result result = minimalResult("1");
  result.error = std::nan("");
  expectError<StoreError>([&] { store.add(result); }, "eth/plain local 1", "error = nan");
  result = minimalResult("1");
  result.runtime = -1.0;
  expectError<StoreError>([&] { store.add(result); }, "runtime_s = -1", "expected 0 to");
  result = minimalResult("1");
  result.overlap = 1.5;
  expectError<StoreError>([&] { store.add(result); }, "overlap = 1.5");
  result = fullResult("1");
  result.orientation.reset();
  expectError<StoreError>([&] { store.add(result); }, "half a pose");
  result = fullResult("1");
  result.position->x() = std::numeric_limits<double>::infinity();
  expectError<StoreError>([&] { store.add(result); }, "not finite");
  EXPECT_TRUE(store.finished().empty());
}

TEST_F(ResultsStoreTest, KeepsCovariancesThatAreNotFinite) {
  Result result = fullResult("1");
  (*result.covariance)[0] = std::numeric_limits<double>::infinity();
  (*result.covariance)[35] = -0.0;
  ResultsStore store = writer();
  store.add(result);
  expectEqual(store.results().at(0), result);
}

TEST_F(ResultsStoreTest, AddsManyAtOnceOrNone) {
  ResultsStore store = writer();
  store.addAll({fullResult("1"), fullResult("2")});
  EXPECT_EQ(store.count(), 2U);
  expectError<StoreError>(
      [&] {
        store.addAll({fullResult("3"), fullResult("1")});
      },
      "found a result of eth/plain local 1");
  EXPECT_EQ(store.count(), 2U);
  store.add(fullResult("3"));
  EXPECT_EQ(store.count(), 3U);
}

TEST_F(ResultsStoreTest, HasARunTableThatIsWrittenBeforeTheFirstResultAndUpdatedByKey) {
  const std::map<std::string, std::string> info{{"secret", "00"}, {"seed", "1"}};
  {
    ResultsStore store = writer();
    EXPECT_TRUE(store.runInfo().empty());
    store.setRunInfo({{"seed", "2"}, {"root", "/data"}});
    store.setRunInfo(info);
    EXPECT_EQ(store.runInfo(), info);
    store.add(fullResult("1"));
    expectError<StoreError>([&] { store.setRunInfo({{"seed", "2"}}); }, "expected a new store");
    store.updateRunInfo("client", "node");
    store.updateRunInfo("seed", "3");
  }
  const std::map<std::string, std::string> expected{
      {"client", "node"}, {"secret", "00"}, {"seed", "3"}};
  EXPECT_EQ(reader().runInfo(), expected);
}

TEST_F(ResultsStoreTest, NotesSessionsAndLeavesTheEndOfAKilledOneUnknown) {
  {
    ResultsStore store = writer();
    expectError<StoreError>([&] { store.endSession(1.0); }, "no session");
    store.beginSession(10.0, "host", 7);
  }  // as if killed
  {
    ResultsStore store = writer();
    store.beginSession(20.0, "host", 8);
    store.endSession(30.0);
  }
  runSql(database(),
         "CREATE TEMP TABLE t (c CHECK (c = '10.0,?,host,7;20.0,30.0,host,8'));"
         "INSERT INTO t SELECT group_concat(started || ',' || coalesce(ended, '?') || ',' || host "
         "|| ',' || pid, ';') FROM session");
  const std::vector<Session> sessions = reader().sessions();
  ASSERT_EQ(sessions.size(), 2U);
  EXPECT_EQ(sessions[0].ended, std::nullopt);
  EXPECT_EQ(sessions[1].started, 20.0);
  EXPECT_EQ(sessions[1].ended, 30.0);
  EXPECT_EQ(sessions[1].host, "host");
  EXPECT_EQ(sessions[1].pid, 8);
}

TEST_F(ResultsStoreTest, IsTheDatabaseOfTheDesign) {
  {
    ResultsStore store = writer();
    store.add(fullResult("1"));
  }
  runSql(
      database(),
      "CREATE TEMP TABLE t (version CHECK (version = 1), mode CHECK (mode = 'wal'));"
      "INSERT INTO t SELECT user_version, journal_mode FROM pragma_user_version, "
      "pragma_journal_mode;"
      "SELECT rotation_error_rad, translation_error_m, runtime_s, solver_time_s, qw FROM result");
}

TEST_F(ResultsStoreTest, RefusesASecondWriterNamingTheFirst) {
  const ResultsStore first = writer();
  expectError<StoreError>([&] { writer(); }, run(), "another writer",
                          "process " + std::to_string(getpid()));
}

TEST_F(ResultsStoreTest, TakesTheNextWriterWhenTheFirstIsGone) {
  { const ResultsStore first = writer(); }
  EXPECT_NO_THROW(writer());
}

TEST_F(ResultsStoreTest, IsReadWhileAWriterIsActive) {
  ResultsStore store = writer();
  store.add(minimalResult("1"));
  const ResultsStore second = reader();
  EXPECT_EQ(second.results().size(), 1u);
  store.add(minimalResult("2"));
  EXPECT_EQ(second.results().size(), 2u);
}

TEST_F(ResultsStoreTest, IsNotWrittenWhenOpenedReadOnly) {
  { writer(); }
  ResultsStore store = reader();
  expectError<StoreError>([&] { store.add(minimalResult("1")); }, database(), "read only");
  expectError<StoreError>([&] { store.updateRunInfo("a", "b"); }, database(), "readonly");
}

TEST_F(ResultsStoreTest, MissingIsAnErrorForAReader) {
  expectError<StoreError>([&] { reader(); }, database(), "found no file");
  EXPECT_FALSE(std::filesystem::exists(run()));
}

TEST_F(ResultsStoreTest, RefusesAFileThatIsNoDatabaseAndLeavesItAlone) {
  const std::string text(5000, 'x');
  makeDatabase(text);
  expectError<StoreError>([&] { writer(); }, database(), "not a database");
  expectError<StoreError>([&] { reader(); }, database(), "not a database");
  EXPECT_EQ(readFile(database()), text);
}

TEST_F(ResultsStoreTest, RefusesAnotherProgramsDatabaseAndLeavesItAlone) {
  makeDatabase("");
  runSql(database(), "CREATE TABLE mine (a)");
  const std::string before = readFile(database());
  expectError<StoreError>([&] { writer(); }, database(), "user_version 0", "expected 1");
  EXPECT_EQ(readFile(database()), before);
}

TEST_F(ResultsStoreTest, RefusesAnotherVersionsStore) {
  { writer(); }
  runSql(database(), "PRAGMA user_version = 2");
  expectError<StoreError>([&] { writer(); }, database(), "user_version 2", "expected 1");
}

TEST_F(ResultsStoreTest, RefusesAStoreWithOtherColumns) {
  { writer(); }
  runSql(database(), "ALTER TABLE result RENAME COLUMN error TO cost");
  expectError<StoreError>([&] { writer(); }, database(), "reason, cost", "reason, error");
  runSql(database(), "DROP TABLE result");
  expectError<StoreError>([&] { reader(); }, database(), "no table `result`");
}

TEST_F(ResultsStoreTest, RefusesADamagedStore) {
  {
    ResultsStore store = writer();
    for (int i = 0; i < 200; ++i) store.add(fullResult(std::to_string(i)));
  }
  std::string bytes = readFile(database());
  ASSERT_GT(bytes.size(), 40000u);
  bytes.replace(5 * 4096, 4096, 4096, '\xff');
  makeDatabase(bytes);
  expectError<StoreError>([&] { writer(); }, database(), "damaged");
}

TEST_F(ResultsStoreTest, RefusesValuesThatItWouldNotHaveWritten) {
  {
    ResultsStore store = writer();
    store.add(fullResult("1"));
  }
  runSql(database(), "UPDATE result SET covariance = '1 2 3'");
  expectError<StoreError>([&] { reader().results(); }, database(), "1 2 3", "36 numbers");
  runSql(database(), "UPDATE result SET covariance = NULL, scans_used = -1");
  expectError<StoreError>([&] { reader().results(); }, database(), "count of -1");
  runSql(database(), "PRAGMA ignore_check_constraints = 1; UPDATE result SET kind = 'both'");
  expectError<StoreError>([&] { reader().finished(); }, database(), "both", "expected");
}

TEST_F(ResultsStoreTest, ReadsAsStrictlyAsItWritesNamingRowAndColumn) {
  const std::vector<std::pair<std::string, std::string>> changes{
      {"error = 'abc'", "found error = `abc`, expected a number"},
      {"error = -1", "found error = -1, expected 0 to"},
      {"error = 9e999", "found error = inf, expected 0 to"},
      {"overlap = 7", "found overlap = 7, expected 0 to 1"},
      {"overlap = 'half'", "found overlap = `half`"},
      {"runtime_s = -1", "found runtime_s = -1"},
      {"rotation_error_rad = 4", "found rotation_error_rad = 4"},
      {"qw = 'x'", "found qw = `x`"},
      {"scans_used = 'many'", "found scans_used = `many`"},
      {"finished = 'today'", "found finished = `today`"}};
  { writer().add(fullResult("1")); }
  for (const auto& [change, message] : changes) {
    const std::string sql = "UPDATE result SET " + change;
    const std::string good = readFile(database());
    runSql(database(), sql.c_str());
    expectError<StoreError>([&] { reader().results(); }, database(), "result of ", message);
    makeDatabase(good);
  }
  EXPECT_EQ(reader().results().size(), 1u);
}

TEST_F(ResultsStoreTest, StartsAnewFromTheEmptyFileOfAWriterKilledAtOnce) {
  makeDatabase("");
  expectError<StoreError>([&] { reader(); }, database(), "empty database");
  EXPECT_NO_THROW(writer().add(minimalResult("1")));
}

TEST_F(ResultsStoreTest, RefusesAFolderThatCannotBeMade) {
  std::ofstream(folder_.file("runs")) << "a file";
  expectError<StoreError>([&] { writer(); }, run(), "cannot make this folder");
}

TEST_F(ResultsStoreTest, TakesAnyFolderName) {
  const std::string folder = folder_.file("50% of #1? file:ä");
  ResultsStore(folder, Access::kReadWrite).add(minimalResult("1"));
  EXPECT_EQ(ResultsStore(folder, Access::kReadOnly).results().size(), 1u);
}

TEST_F(ResultsStoreTest, ExportsAllColumnsAsCsvWithEmptyFieldsForNull) {
  ResultsStore store = writer();
  Result quoted = minimalResult("2");
  quoted.reason = "says \"no\",\nthen dies";
  store.add(fullResult("1"));
  store.add(quoted);
  store.exportCsv();
  std::string covariance = "0";
  for (int i = 1; i < 36; ++i) covariance += " " + std::to_string(i) + ".5";
  EXPECT_EQ(readFile(run() + "/results.csv"),
            "data_set,sequence,kind,problem_id,source,target,overlap,outcome,reason,error,"
            "initial_misalignment,rotation_error_rad,translation_error_m,runtime_s,solver_time_s,"
            "scans_used,target_changed,replies_rejected,x,y,z,qx,qy,qz,qw,covariance,finished\n"
            "eth,plain,local,1,a.pcd,b.pcd,0.4567,replied,,0.1,0.3,0.01,0.2,1.25,1,3,1,2,1.5,-2.5,"
            "1e-300,0.5,-0.5,0.5,0.5," +
                covariance +
                ",1700000000.25\n"
                "eth,plain,local,2,a.pcd,b.pcd,0.5,timed_out,\"says \"\"no\"\",\nthen dies\",0.3,"
                "0.3,0.01,0.2,,,,0,0,,,,,,,,,1700000000.5\n");
}

TEST_F(ResultsStoreTest, KeepsAndReadsReasonsOfAnyBytesAsPrintableText) {
  Result odd = minimalResult("1");
  odd.reason =
      "\xc9"
      "chec\x1b";
  ResultsStore store = writer();
  store.add(odd);
  const std::string printable =
      "\xef\xbf\xbd"
      "chec\xef\xbf\xbd";
  runSql(database(), ("UPDATE result SET source = CASE reason WHEN '" + printable +
                      "' THEN 'kept' ELSE 'other' END, reason = CAST(X'C9636865631B' AS TEXT)")
                         .c_str());  // as older stores have it
  EXPECT_EQ(store.results()[0].source, "kept");
  EXPECT_EQ(store.results()[0].reason, printable);
  store.exportCsv();
  EXPECT_NE(readFile(run() + "/results.csv").find(",timed_out," + printable + ",0.3,"),
            std::string::npos);
}

TEST_F(ResultsStoreTest, MovesWithWhatItHolds) {
  ResultsStore first = writer();
  ResultsStore second = std::move(first);
  second.add(minimalResult("1"));
  first = ResultsStore(folder_.file("other"), Access::kReadWrite);
  EXPECT_TRUE(first.finished().empty());
  EXPECT_EQ(second.finished().size(), 1u);
}

}  // namespace
}  // namespace pcrb
