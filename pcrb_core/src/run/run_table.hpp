#pragma once

#include <functional>
#include <optional>
#include <string>

#include "pcrb_core/run/run_info.hpp"

namespace pcrb {

/// What a key of the run table is compared in.
enum class RunKeyRole {
  kConfiguration,  ///< when a run goes on, and between shards
  kShard,          ///< when a run goes on: it is what shards differ in
  kClient,         ///< between clients and between shards
  kRecorded,       ///< between shards
  kOwn             ///< nowhere: says when and where a shard ran
};

/// One key of the run table.
struct RunTableRow {
  const char* key;
  RunKeyRole role;
  bool is_shown;  ///< in reports
  /// Nothing where the value is unknown, or a default that is not written.
  std::function<std::optional<std::string>(const RunInfo&)> write;
  std::function<void(RunInfo&, const std::string&)> read;  ///< @throws InvalidParameter
};

/// Keys that are a word, a blank and a name each, one for each name.
struct NamedRunTableRows {
  std::string prefix;  ///< the word and the blank
  RunKeyRole role;
  std::map<std::string, std::string> RunInfo::*member;
  bool may_lack = false;  ///< whether a key that only one of two tables has is no difference
  void (*check)(const std::string&) = nullptr;  ///< @throws InvalidParameter
};

/// A text of the run table for messages; `nothing` where there is none.
std::string inBackticks(const std::optional<std::string>& text);

/// All rows of the first kind, and of the second.
const std::vector<RunTableRow>& runTableRows();
const std::vector<NamedRunTableRows>& namedRunTableRows();

/// The row or the rows that a key is of; nothing for a key of another kind.
const RunTableRow* findRunTableRow(const std::string& key);
const NamedRunTableRows* findNamedRunTableRows(const std::string& key);

}  // namespace pcrb
