#include "pcrb_core/run/run_info.hpp"

#include <algorithm>
#include <sstream>
#include <utility>

#include "pcrb_core/error.hpp"
#include "run/run_table.hpp"

namespace pcrb {

namespace {

using RunTable = std::map<std::string, std::string>;

void readRunKey(RunInfo& info, const std::string& key, const std::string& text) {
  if (const RunTableRow* row = findRunTableRow(key)) {
    row->read(info, text);
  } else if (const NamedRunTableRows* rows = findNamedRunTableRows(key)) {
    if (rows->check != nullptr) rows->check(text);
    (info.*rows->member)[key.substr(rows->prefix.size())] = text;
  } else {
    info.others[key] = text;
  }
}

RunKeyRole roleOfRunKey(const std::string& key) {
  if (const RunTableRow* row = findRunTableRow(key)) return row->role;
  const NamedRunTableRows* rows = findNamedRunTableRows(key);
  return rows != nullptr ? rows->role : RunKeyRole::kRecorded;
}

bool isCompared(RunKeyRole role, RunInfo::Scope scope) {
  switch (scope) {
    case RunInfo::Scope::kResume:
      return role == RunKeyRole::kConfiguration || role == RunKeyRole::kShard;
    case RunInfo::Scope::kClient:
      return role == RunKeyRole::kClient;
    case RunInfo::Scope::kShards:
      return role == RunKeyRole::kConfiguration || role == RunKeyRole::kClient ||
             role == RunKeyRole::kRecorded;
  }
  return false;
}

std::optional<std::string> valueOfKey(const RunTable& table, const std::string& key) {
  const auto found = table.find(key);
  return found == table.end() ? std::nullopt : std::make_optional(found->second);
}

/// The lines of a text that another one has not, separated by `, `.
std::string linesOnlyIn(const std::string& text, const std::string& other) {
  std::istringstream lines(text);
  std::string found;
  for (std::string line; std::getline(lines, line);) {
    const bool is_common = ("\n" + other + "\n").find("\n" + line + "\n") != std::string::npos;
    if (!is_common) found += (found.empty() ? "" : ", ") + line;
  }
  return found;
}

/// Of parameters, a line each, those that differ.
void keepDifferentLines(RunInfo::Difference& difference) {
  if (!difference.here || !difference.there) return;
  const std::string here = *difference.here;
  difference.here = linesOnlyIn(here, *difference.there);
  difference.there = linesOnlyIn(*difference.there, here);
}

/// What users call a key of the run's table.
std::string parameterOf(const std::string& key) {
  if (key == "upright") return "yaw_only";
  return key == "kinds" ? "kind" : key;
}

}  // namespace

RunInfo RunInfo::of(const RunConfiguration& configuration, const RunPlan& plan) {
  RunInfo info;
  info.configuration = configuration;
  info.code_version = PCRB_VERSION;
  info.problem_files = plan.problem_files;
  info.drawn_by = plan.drawn_by;
  info.voxel_leaves = plan.voxel_leaves;
  info.problems = plan.problems.size();
  return info;
}

RunInfo RunInfo::read(const RunTable& table, const std::string& path) {
  RunInfo info;
  for (const RunTableRow& row : runTableRows()) {
    if (table.count(row.key) == 0) info.absent.insert(row.key);
  }
  for (const auto& [key, text] : table) {
    try {
      readRunKey(info, key, text);
    } catch (const Error& error) {
      throw StoreError(path + ": run table, " + key + ": " + error.what());
    }
  }
  return info;
}

RunTable RunInfo::write() const {
  RunTable table = others;
  for (const RunTableRow& row : runTableRows()) {
    const bool has_default =
        row.role == RunKeyRole::kConfiguration || row.role == RunKeyRole::kShard;
    if (has_default && absent.count(row.key) > 0) continue;
    if (const auto text = row.write(*this)) table[row.key] = *text;
  }
  for (const NamedRunTableRows& rows : namedRunTableRows()) {
    for (const auto& [name, value] : this->*rows.member) table[rows.prefix + name] = value;
  }
  return table;
}

RunTable RunInfo::writeShown() const {
  RunTable shown;
  for (const auto& [key, text] : write()) {
    const RunTableRow* row = findRunTableRow(key);
    if (row != nullptr && row->is_shown) shown[key] = text;
  }
  return shown;
}

bool RunInfo::needsSecret() const {
  return configuration.presentation.isLocalization() || configuration.presentation.audit;
}

std::optional<Secret> RunInfo::secretOf(const ProblemKey& key) const {
  if (secret) return secret;
  if (!needsSecret()) return Secret();
  const auto found = shard_secrets.find(key.subject());
  return found == shard_secrets.end() ? std::nullopt
                                      : std::optional(Secret::fromHex(found->second));
}

bool RunInfo::isOfARun() const { return absent.count("shard") == 0; }

std::vector<RunInfo::Difference> RunInfo::differences(const RunInfo& other, Scope scope) const {
  const RunTable table_here = write();
  const RunTable table_there = other.write();
  RunTable keys = table_here;
  keys.insert(table_there.begin(), table_there.end());
  std::vector<Difference> differences;
  for (const auto& [key, text] : keys) {
    if (!isCompared(roleOfRunKey(key), scope)) continue;
    Difference difference{parameterOf(key), valueOfKey(table_here, key),
                          valueOfKey(table_there, key)};
    const NamedRunTableRows* rows = findNamedRunTableRows(key);
    const bool may_lack = rows != nullptr && rows->may_lack;
    if (may_lack && (!difference.here || !difference.there)) continue;
    if (difference.here == difference.there) continue;
    keepDifferentLines(difference);
    differences.push_back(std::move(difference));
  }
  return differences;
}

void RunInfo::merge(const RunInfo& shard) {
  clouds.insert(shard.clouds.begin(), shard.clouds.end());
  if (problems) *problems += shard.problems.value_or(0);
  node_cpu_time += shard.node_cpu_time;
  foreign_replies += shard.foreign_replies;
  node_peak_memory = std::max(node_peak_memory, shard.node_peak_memory);
}

}  // namespace pcrb
