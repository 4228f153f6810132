#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>

#include "pcrb_core/run/result.hpp"
#include "run/sqlite.hpp"

namespace pcrb {

/// Statements that make the tables of a results store (docs/formats.md).
extern const char* const kResultsSchema;

/// `INSERT` of one row with a placeholder for each column.
std::string insertSql(const std::string& table, const std::string& columns);

/// Nothing for NULL.
std::optional<double> optionalReal(const Statement& row, int column);

/// Seven columns: x y z of the position, x y z w of the orientation; NULL where there is none.
void bindPose(const std::optional<Eigen::Vector3d>& position,
              const std::optional<Eigen::Quaterniond>& orientation, Statement& statement);
void readPose(const Statement& row, int first_column, std::optional<Eigen::Vector3d>& position,
              std::optional<Eigen::Quaterniond>& orientation);

/// Statement that makes the table of scans, which stores of older versions lack.
extern const char* const kScanSchema;

/// Names of the columns of table `scan`, in order, separated by `, `.
extern const char* const kScanColumns;

/// `INSERT` of one scan, for bindScan.
std::string insertScanSql();

void bindScan(const ProblemKey& key, const ScanRecord& record, Statement& statement);

/// Reads a row of `SELECT kScanColumns`.
ScanRecord readScan(const Statement& row);

/// Names of the columns of table `result`, in order, separated by `, `.
extern const char* const kResultColumns;

/// The order in which results are listed, that of ProblemKey.
extern const char* const kResultOrder;

/// `INSERT` of one row, for bindResult.
std::string insertResultSql();

/// Binds all columns. Covariance becomes text: 36 numbers in their shortest exact form, separated
/// by spaces, so that it reads the same in a shell, in CSV and here.
void bindResult(const Result& result, Statement& statement);

/// Reads a row of `SELECT kResultColumns`.
/// @throws StoreError  naming row and column, if a value is not what bindResult writes.
Result readResult(const Statement& row, const std::string& path);

/// Reads the key from the first four columns of a row.
/// @throws StoreError  if the kind is unknown.
ProblemKey readKey(const Statement& row, const std::string& path);

/// @throws StoreError  naming the column, if a number is not finite or out of range.
void requireStorable(const Result& result, const std::string& path);

/// Opens a results store, makes it where missing or empty, and sees to it that commits last.
/// @throws StoreError  naming the file and what it is instead, or why it cannot be written.
Database openStoreForWriting(const std::string& path);

/// Opens a results store that exists, also beside an active writer and on a read-only disk.
/// @throws StoreError  naming the file and what it is instead, or why it cannot be read.
Database openStoreForReading(const std::string& path);

}  // namespace pcrb
