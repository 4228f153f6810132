#include <algorithm>
#include <cmath>
#include <limits>

#include "pcrb_core/io/number.hpp"
#include "pcrb_core/io/text.hpp"
#include "pcrb_core/run/results_store.hpp"
#include "run/store_tables.hpp"

namespace pcrb {

const char* const kResultsSchema = R"(
CREATE TABLE run (key TEXT PRIMARY KEY NOT NULL, value TEXT NOT NULL) WITHOUT ROWID;
CREATE TABLE session (started REAL NOT NULL, ended REAL, host TEXT NOT NULL, pid INTEGER NOT NULL);
CREATE TABLE result (
  data_set TEXT NOT NULL,
  sequence TEXT NOT NULL,
  kind TEXT NOT NULL CHECK (kind IN ('local', 'global')),
  problem_id TEXT NOT NULL,
  source TEXT NOT NULL,
  target TEXT NOT NULL,
  overlap REAL NOT NULL,
  outcome TEXT NOT NULL
    CHECK (outcome IN ('replied', 'failed', 'timed_out', 'rejected', 'skipped')),
  reason TEXT NOT NULL,
  error REAL NOT NULL,
  initial_misalignment REAL NOT NULL,
  rotation_error_rad REAL NOT NULL,
  translation_error_m REAL NOT NULL,
  runtime_s REAL,
  solver_time_s REAL,
  scans_used INTEGER,
  target_changed INTEGER NOT NULL CHECK (target_changed IN (0, 1)),
  replies_rejected INTEGER NOT NULL,
  x REAL, y REAL, z REAL, qx REAL, qy REAL, qz REAL, qw REAL,
  covariance TEXT,
  finished REAL NOT NULL,
  PRIMARY KEY (data_set, sequence, kind, problem_id)
) WITHOUT ROWID;
)";

const char* const kResultColumns =
    "data_set, sequence, kind, problem_id, source, target, overlap, outcome, reason, error, "
    "initial_misalignment, rotation_error_rad, translation_error_m, runtime_s, solver_time_s, "
    "scans_used, target_changed, replies_rejected, x, y, z, qx, qy, qz, qw, covariance, finished";

const char* const kResultOrder = "data_set, sequence, kind = 'global', problem_id";

namespace {

std::string formatCovariance(const std::array<double, 36>& covariance) {
  std::string text;
  for (const double entry : covariance) {
    if (!text.empty()) text += ' ';
    appendShortest(text, entry);
  }
  return text;
}

std::array<double, 36> parseCovariance(const std::string& text, const std::string& path) {
  std::array<double, 36> covariance;
  const char* at = text.data();
  const char* const end = at + text.size();
  for (std::size_t i = 0; i < covariance.size() && at != nullptr; ++i) {
    if (i > 0) at = at != end && *at == ' ' ? at + 1 : end;
    at = scanDouble(at, end, covariance[i]);
  }
  if (at != end) {
    throw StoreError(path + ": found covariance `" + text +
                     "`, expected 36 numbers separated by spaces");
  }
  return covariance;
}

/// The row, for messages.
std::string whereOf(const Result& result, const std::string& path) {
  return path + ": result of " + result.key.subject() + ": ";
}

std::uint32_t readCount(const Statement& row, int column, const std::string& path) {
  const std::int64_t value = row.integer(column);
  if (value < 0 || value > std::numeric_limits<std::uint32_t>::max()) {
    throw StoreError(path + ": found a count of " + std::to_string(value) +
                     ", expected 0 to 2^32 - 1");
  }
  return static_cast<std::uint32_t>(value);
}

/// SQLite takes any text for a number, and 0 for its value: a perfect score.
void requireNumber(const Statement& row, int column, const std::string& where) {
  const int type = row.type(column);
  if (type == SQLITE_FLOAT || type == SQLITE_INTEGER || type == SQLITE_NULL) return;
  throw StoreError(where + "found " + row.name(column) + " = `" + printableText(row.text(column)) +
                   "`, expected a number");
}

/// A number's name and the range that it must lie in.
struct Bounded {
  const char* name;
  double value;
  double min;
  double max;
};

}  // namespace

std::string insertSql(const std::string& table, const std::string& columns) {
  std::string placeholders = "?";
  for (auto i = std::count(columns.begin(), columns.end(), ','); i > 0; --i) placeholders += ", ?";
  return "INSERT INTO " + table + " (" + columns + ") VALUES (" + placeholders + ")";
}

std::optional<double> optionalReal(const Statement& row, int column) {
  if (row.isNull(column)) return std::nullopt;
  return row.real(column);
}

void bindPose(const std::optional<Eigen::Vector3d>& position,
              const std::optional<Eigen::Quaterniond>& orientation, Statement& statement) {
  for (int i = 0; i < 3; ++i) {
    statement.bind(position ? std::optional<double>((*position)[i]) : std::nullopt);
  }
  for (int i = 0; i < 4; ++i) {
    statement.bind(orientation ? std::optional<double>(orientation->coeffs()[i]) : std::nullopt);
  }
}

void readPose(const Statement& row, int first_column, std::optional<Eigen::Vector3d>& position,
              std::optional<Eigen::Quaterniond>& orientation) {
  const auto at = [&](int i) { return row.real(first_column + i); };
  if (!row.isNull(first_column)) position = Eigen::Vector3d(at(0), at(1), at(2));
  if (!row.isNull(first_column + 3)) {
    orientation = Eigen::Quaterniond(at(6), at(3), at(4), at(5));
  }
}

std::string insertResultSql() { return insertSql("result", kResultColumns); }

void bindResult(const Result& result, Statement& statement) {
  statement.bind(result.key.data_set);
  statement.bind(result.key.sequence);
  statement.bind(toString(result.key.kind));
  statement.bind(result.key.problem_id);
  statement.bind(result.source);
  statement.bind(result.target);
  statement.bind(result.overlap);
  statement.bind(toString(result.outcome));
  statement.bind(printableText(result.reason));
  statement.bind(result.error);
  statement.bind(result.initial_misalignment);
  statement.bind(result.rotation_error);
  statement.bind(result.translation_error);
  statement.bind(result.runtime);
  statement.bind(result.solver_time);
  statement.bind(result.scans_used ? std::optional<std::int64_t>(*result.scans_used)
                                   : std::nullopt);
  statement.bind(std::int64_t{result.target_changed});
  statement.bind(std::int64_t{result.replies_rejected});
  bindPose(result.position, result.orientation, statement);
  statement.bind(result.covariance ? std::optional(formatCovariance(*result.covariance))
                                   : std::nullopt);
  statement.bind(result.finished);
}

ProblemKey readKey(const Statement& row, const std::string& path) try {
  return {row.text(0), row.text(1), kindFromString(row.text(2)), row.text(3)};
} catch (const InvalidParameter& error) {
  throw StoreError(path + ": " + error.what());
}

Result readResult(const Statement& row, const std::string& path) try {
  constexpr int kOverlap = 6, kError = 9, kCovariance = 25, kFinished = 26;
  Result result;
  result.key = readKey(row, path);
  const std::string where = whereOf(result, path);
  for (int i = kError; i < kCovariance; ++i) requireNumber(row, i, where);
  for (const int i : {kOverlap, kFinished}) requireNumber(row, i, where);
  int column = 4;
  result.source = row.text(column++);
  result.target = row.text(column++);
  result.overlap = row.real(column++);
  result.outcome = outcomeFromString(row.text(column++));
  result.reason = printableText(row.text(column++));  // older stores have it as it came
  result.error = row.real(column++);
  result.initial_misalignment = row.real(column++);
  result.rotation_error = row.real(column++);
  result.translation_error = row.real(column++);
  result.runtime = optionalReal(row, column++);
  result.solver_time = optionalReal(row, column++);
  if (!row.isNull(column)) result.scans_used = readCount(row, column, path);
  ++column;
  result.target_changed = row.integer(column++) != 0;
  result.replies_rejected = readCount(row, column++, path);
  readPose(row, column, result.position, result.orientation);
  column += 7;
  if (!row.isNull(column)) result.covariance = parseCovariance(row.text(column), path);
  result.finished = row.real(++column);
  requireStorable(result, path);
  return result;
} catch (const InvalidParameter& error) {
  throw StoreError(path + ": " + error.what());
}

void requireStorable(const Result& result, const std::string& path) {
  constexpr double kMax = std::numeric_limits<double>::max();
  const Bounded numbers[] = {
      {"overlap", result.overlap, 0.0, 1.0},
      {"error", result.error, 0.0, kMax},
      {"initial_misalignment", result.initial_misalignment, 0.0, kMax},
      {"rotation_error_rad", result.rotation_error, 0.0, M_PI},
      {"translation_error_m", result.translation_error, 0.0, kMax},
      {"runtime_s", result.runtime.value_or(0.0), 0.0, kMax},
      {"solver_time_s", result.solver_time.value_or(0.0), 0.0, kMax},
      {"finished", result.finished, -kMax, kMax},
  };
  const std::string where = whereOf(result, path);
  for (const Bounded& number : numbers) {
    if (number.value >= number.min && number.value <= number.max) continue;
    throw StoreError(where + "found " + number.name + " = " + formatShortest(number.value) +
                     ", expected " + formatShortest(number.min) + " to " +
                     formatShortest(number.max));
  }
  if (result.position.has_value() != result.orientation.has_value()) {
    throw StoreError(where + "found half a pose, expected position and orientation, or neither");
  }
  if (result.position &&
      !(result.position->allFinite() && result.orientation->coeffs().allFinite())) {
    throw StoreError(where + "found a pose that is not finite");
  }
}

}  // namespace pcrb
