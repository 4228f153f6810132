#include "pcrb_core/run/merge_runs.hpp"

#include <algorithm>
#include <filesystem>
#include <map>

#include "pcrb_core/error.hpp"
#include "pcrb_core/io/atomic_file.hpp"
#include "pcrb_core/problem/secret.hpp"
#include "pcrb_core/run/results_store.hpp"
#include "pcrb_core/run/run_info.hpp"
#include "pcrb_core/run/summary.hpp"
#include "run/run_table.hpp"

namespace pcrb {
namespace {

namespace fs = std::filesystem;

constexpr const char* kMergeScratch = ".merge";

/// A folder that is new, and gone in the end.
struct MergeScratch {
  explicit MergeScratch(const std::string& folder) : path(folder) { fs::remove_all(path); }
  ~MergeScratch() {
    std::error_code ignored;
    fs::remove_all(path, ignored);
  }
  MergeScratch(const MergeScratch&) = delete;
  MergeScratch& operator=(const MergeScratch&) = delete;

  const std::string path;
};

/// One shard's run folder, read.
struct ShardRun {
  std::string folder;
  RunInfo info;
  std::vector<Result> results;
  std::vector<Session> sessions;

  const ShardNumber& shard() const { return info.configuration.selection.shard; }
  std::string name() const { return folder + " (shard " + toString(shard()) + ")"; }
};

ShardRun readShardRun(const std::string& folder) {
  const ResultsStore store(folder, ResultsStore::Access::kReadOnly);
  ShardRun part{folder, RunInfo::read(store), store.results(), store.sessions()};
  auto scans = store.scans();
  for (Result& result : part.results) result.scans = std::move(scans[result.key]);
  if (part.info.isOfARun()) return part;
  throw StoreError(store.path() +
                   ": found shard `` in the run table, expected i/N: is this a run?");
}

void requireComplete(const ShardRun& part) {
  const std::size_t count = part.results.size();
  const auto& problems = part.info.problems;
  if (problems && *problems == count) return;
  throw StoreError(part.name() + ": found results of " + std::to_string(count) +
                   " problems, expected " + (problems ? std::to_string(*problems) : "a number") +
                   ": start this shard again, it goes on where it stopped");
}

/// Compares each shard with all before it, so that clouds are compared among all that used them.
RunInfo requireOneConfiguration(const std::vector<ShardRun>& parts) {
  RunInfo merged = parts.front().info;
  for (auto part = parts.begin() + 1; part != parts.end(); ++part) {
    std::string text;
    for (const auto& [parameter, here, there] :
         merged.differences(part->info, RunInfo::Scope::kShards)) {
      text += "; " + parameter + ": " + inBackticks(here) + " and " + inBackticks(there);
    }
    if (!text.empty()) {
      throw StoreError(part->name() + ": found another configuration than in " +
                       parts.front().name() + ", expected the same" + text);
    }
    merged.merge(part->info);
  }
  return merged;
}

/// Each of the shards 0/N … (N − 1)/N, once.
void requireEveryShard(const std::vector<ShardRun>& parts) {
  const std::size_t shards = parts.front().shard().count;
  std::map<std::size_t, std::string> folders;
  for (const ShardRun& part : parts) {
    if (part.shard().count != shards) {
      throw StoreError(part.name() + ": found a part of " + std::to_string(part.shard().count) +
                       ", expected one of " + std::to_string(shards) + " as in " +
                       parts.front().name());
    }
    const auto [other, is_new] = folders.emplace(part.shard().index, part.folder);
    if (!is_new) {
      throw StoreError(part.name() + ": found the shard that is in " + other->second +
                       " too, expected every shard once");
    }
  }
  std::string missing;
  for (std::size_t i = 0; i < shards; ++i) {
    if (folders.count(i) == 0) missing += " " + toString(ShardNumber{i, shards});
  }
  if (!missing.empty()) throw StoreError("expected every shard, missing are" + missing);
}

/// The shards' secret; none if they have several.
std::optional<Secret> commonSecret(const std::vector<ShardRun>& parts) {
  const std::optional<Secret>& first = parts.front().info.secret;
  for (const ShardRun& part : parts) {
    const std::optional<Secret>& other = part.info.secret;
    if (!first || !other || first->toHex() != other->toHex()) return std::nullopt;
  }
  return first;
}

/// Each problem's, by its subject: with another one, clouds would not be found where they were
/// shown.
std::map<std::string, std::string> secretsByProblem(const std::vector<ShardRun>& parts) {
  std::map<std::string, std::string> secrets;
  for (const ShardRun& part : parts) {
    for (const Result& result : part.results) {
      const auto secret = part.info.secretOf(result.key);
      if (secret) secrets[result.key.subject()] = secret->toHex();
    }
  }
  return secrets;
}

RunInfo asMerged(RunInfo info, const std::vector<ShardRun>& parts) {
  info.configuration.selection.shard = ShardNumber{};
  info.secret = commonSecret(parts);
  if (info.needsSecret() && !info.secret) info.shard_secrets = secretsByProblem(parts);
  info.created = secondsSinceEpoch();
  info.merged_from = std::to_string(parts.size()) + " shards";
  return info;
}

void requireReplaceableRun(const std::string& folder) {
  if (!fs::exists(folder + "/results.sqlite")) return;
  const ResultsStore store(folder, ResultsStore::Access::kReadOnly);
  if (!RunInfo::read(store).merged_from.empty()) return;
  throw StoreError(store.path() + ": found a run that no merge made, expected a free folder");
}

std::string writeRun(const std::string& folder, const std::vector<ShardRun>& parts,
                     const RunInfo& info) {
  ResultsStore store(folder, ResultsStore::Access::kReadWrite);
  std::vector<Result> results;
  std::vector<Session> sessions;
  for (const ShardRun& part : parts) {
    results.insert(results.end(), part.results.begin(), part.results.end());
    sessions.insert(sessions.end(), part.sessions.begin(), part.sessions.end());
  }
  store.setRunInfo(asMerged(info, parts).write());
  store.addAll(results);
  std::stable_sort(sessions.begin(), sessions.end(),
                   [](const auto& a, const auto& b) { return a.started < b.started; });
  for (const Session& session : sessions) {
    store.beginSession(session.started, session.host, session.pid);
    if (session.ended) store.endSession(*session.ended);
  }
  store.exportCsv();
  const std::string summary = formatSummary(summarize(results)) + describeScans(results);
  writeFileAtomically(folder + "/summary.txt", summary);
  return summary;
}

std::string describeDefects(const std::vector<ShardRun>& parts) {
  std::string defects;
  for (const ShardRun& part : parts) {
    const std::string silence = describeSilence(part.results);
    if (!silence.empty()) defects += part.name() + ": " + silence + "\n";
  }
  return defects;
}

}  // namespace

std::string describeSilence(const std::vector<Result>& results) {
  if (std::any_of(results.begin(), results.end(), isAnswered)) return "";
  return "the node under test never answered: found no reply to " + std::to_string(results.size()) +
         " problems, expected at least one";
}

MergeReport mergeRuns(const MergeOptions& options) {
  if (options.runs.empty()) throw InvalidParameter("found no run, expected the shards of one");
  std::vector<ShardRun> parts;
  for (const auto& run : options.runs) parts.push_back(readShardRun(run));
  requireReplaceableRun(options.output);
  const RunInfo info = requireOneConfiguration(parts);
  requireEveryShard(parts);
  for (const ShardRun& part : parts) requireComplete(part);

  const MergeScratch scratch(options.output + "/" + kMergeScratch);
  const std::string summary = writeRun(scratch.path, parts, info);
  for (const char* leftover : {"results.sqlite-wal", "results.sqlite-shm"}) {
    fs::remove(options.output + "/" + leftover);
  }
  for (const char* file : {"results.sqlite", "results.csv", "summary.txt"}) {
    fs::rename(scratch.path + "/" + file, options.output + "/" + file);
  }
  return {summary, describeDefects(parts)};
}

}  // namespace pcrb
