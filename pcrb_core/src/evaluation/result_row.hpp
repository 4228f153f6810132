#pragma once

#include <string>

#include "evaluation/sqlite.hpp"
#include "pcrb_core/evaluation/result.hpp"

namespace pcrb {

/// Statements that make the tables of a results store (docs/formats.md).
extern const char* const kResultsSchema;

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
/// @throws StoreError  if a value is not what bindResult writes.
Result readResult(const Statement& row, const std::string& path);

/// Reads the key from the first four columns of a row.
/// @throws StoreError  if the kind is unknown.
ProblemKey readKey(const Statement& row, const std::string& path);

/// @throws StoreError  naming the column, if a number is not finite or out of range.
void requireStorable(const Result& result, const std::string& path);

/// `data_set/sequence kind problem_id`, for messages.
std::string describeKey(const ProblemKey& key);

}  // namespace pcrb
