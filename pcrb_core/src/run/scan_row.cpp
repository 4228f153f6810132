#include <algorithm>

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

std::string insertScanSql() {
  const std::string columns = kScanColumns;
  std::string placeholders = "?";
  for (auto i = std::count(columns.begin(), columns.end(), ','); i > 0; --i) placeholders += ", ?";
  return "INSERT INTO scan (" + columns + ") VALUES (" + placeholders + ")";
}

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
  for (int i = 0; i < 3; ++i) {
    statement.bind(record.position ? std::optional<double>((*record.position)[i]) : std::nullopt);
  }
  for (int i = 0; i < 4; ++i) {  // x y z w
    statement.bind(record.orientation ? std::optional<double>(record.orientation->coeffs()[i])
                                      : std::nullopt);
  }
}

ScanRecord readScan(const Statement& row) {
  const auto real = [&](int column) {
    return row.isNull(column) ? std::nullopt : std::optional<double>(row.real(column));
  };
  ScanRecord record;
  record.scan = static_cast<std::uint32_t>(row.integer(4));
  record.sent = row.real(5);
  record.answered = real(6);
  record.is_echo = row.integer(7) != 0;
  record.error = real(8);
  if (!row.isNull(9)) record.position = Eigen::Vector3d(row.real(9), row.real(10), row.real(11));
  if (!row.isNull(12)) {
    record.orientation = Eigen::Quaterniond(row.real(15), row.real(12), row.real(13), row.real(14));
  }
  return record;
}

}  // namespace pcrb
