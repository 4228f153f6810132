#include "pcrb_core/run/results_store.hpp"
#include "run/store_tables.hpp"

namespace pcrb {

const char* const kScanSchema = R"(
CREATE TABLE IF NOT EXISTS scan (
  data_set TEXT NOT NULL,
  sequence TEXT NOT NULL,
  kind TEXT NOT NULL CHECK (kind IN ('local', 'global')),
  problem_id TEXT NOT NULL,
  scan INTEGER NOT NULL,
  sent_s REAL NOT NULL,
  answered_s REAL,
  is_echo INTEGER NOT NULL CHECK (is_echo IN (0, 1)),
  error REAL,
  x REAL, y REAL, z REAL, qx REAL, qy REAL, qz REAL, qw REAL,
  PRIMARY KEY (data_set, sequence, kind, problem_id, scan)
) WITHOUT ROWID;
)";

const char* const kScanColumns =
    "data_set, sequence, kind, problem_id, scan, sent_s, answered_s, is_echo, error, x, y, z, qx, "
    "qy, qz, qw";

std::string insertScanSql() { return insertSql("scan", kScanColumns); }

void bindScan(const ProblemKey& key, const ScanRecord& record, Statement& statement) {
  statement.bind(key.data_set);
  statement.bind(key.sequence);
  statement.bind(toString(key.kind));
  statement.bind(key.problem_id);
  statement.bind(std::int64_t{record.scan});
  statement.bind(record.sent);
  statement.bind(record.answered);
  statement.bind(std::int64_t{record.is_echo});
  statement.bind(record.error);
  bindPose(record.position, record.orientation, statement);
}

ScanRecord readScan(const Statement& row) {
  ScanRecord record;
  record.scan = static_cast<std::uint32_t>(row.integer(4));
  record.sent = row.real(5);
  record.answered = optionalReal(row, 6);
  record.is_echo = row.integer(7) != 0;
  record.error = optionalReal(row, 8);
  readPose(row, 9, record.position, record.orientation);
  return record;
}

}  // namespace pcrb
