#include "benchmarking/merge_tool.hpp"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <map>
#include <set>

#include "pcrb_core/error.hpp"
#include "pcrb_core/evaluation/result.hpp"
#include "pcrb_core/evaluation/results_store.hpp"
#include "pcrb_core/evaluation/summary.hpp"
#include "pcrb_core/io/atomic_file.hpp"
#include "pcrb_core/io/number.hpp"
#include "pcrb_core/problem/secret.hpp"

namespace pcrb_tools {
namespace {

namespace fs = std::filesystem;

using Info = std::map<std::string, std::string>;

constexpr const char* kMergedFrom = "merged_from";       ///< key that only merged runs have
constexpr const char* kNodeCpuTime = "node_cpu_time_s";  ///< summed
constexpr const char* kNodePeakMemory = "node_peak_memory_bytes";  ///< the greatest counts
constexpr const char* kCloudPrefix = "cloud ";
constexpr const char* kScratch = ".merge";

/// A folder that is new, and gone in the end.
struct ScratchFolder {
  explicit ScratchFolder(const std::string& folder) : path(folder) { fs::remove_all(path); }
  ~ScratchFolder() {
    std::error_code ignored;
    fs::remove_all(path, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  const std::string path;
};

/// One shard's run folder, read.
struct Part {
  std::string folder;
  Info info;
  std::vector<pcrb::Result> results;
  std::vector<pcrb::Session> sessions;
  std::int64_t shard = 0;
  std::int64_t shards = 0;

  std::string name() const { return folder + " (shard " + info.at("shard") + ")"; }
};

Part readPart(const std::string& folder) {
  const pcrb::ResultsStore store(folder, pcrb::ResultsStore::Access::kReadOnly);
  Part part{folder, store.runInfo(), store.results(), store.sessions()};
  const std::string text = part.info["shard"];
  const std::size_t slash = std::min(text.find('/'), text.size());
  const auto shard = pcrb::parseInt(text.substr(0, slash));
  const auto shards = pcrb::parseInt(slash < text.size() ? text.substr(slash + 1) : "");
  if (!shard || !shards || *shard < 0 || *shard >= *shards) {
    throw pcrb::StoreError(store.path() + ": found shard `" + text +
                           "` in the run table, expected i/N: is this a run?");
  }
  part.shard = *shard;
  part.shards = *shards;
  return part;
}

void requireComplete(const Part& part) {
  const std::string count = std::to_string(part.results.size());
  const auto found = part.info.find("problems");
  const std::string expected = found == part.info.end() ? "a number" : found->second;
  if (count == expected) return;
  throw pcrb::StoreError(part.name() + ": found results of " + count + " problems, expected " +
                         expected + ": start this shard again, it goes on where it stopped");
}

/// What may differ between shards: what says which shard it is, when and where it ran.
bool isOfOneShard(const std::string& key) {
  static const std::set<std::string> keys{"shard",    "secret",     "created",      "root",
                                          "problems", kNodeCpuTime, kNodePeakMemory};
  return keys.count(key) > 0;
}

bool isCloud(const std::string& key) { return key.rfind(kCloudPrefix, 0) == 0; }

/// Keys that both have with other values, and those that only one has. A cloud that only one shard
/// used is no difference.
std::string differences(const Info& a, const Info& b) {
  std::set<std::string> keys;
  for (const auto& [key, value] : a) keys.insert(key);
  for (const auto& [key, value] : b) keys.insert(key);
  const auto valueIn = [](const Info& info, const std::string& key) {
    const auto found = info.find(key);
    return found == info.end() ? "nothing" : "`" + found->second + "`";
  };
  std::string text;
  for (const auto& key : keys) {
    if (isOfOneShard(key) || (isCloud(key) && (a.count(key) == 0 || b.count(key) == 0))) continue;
    const std::string in_a = valueIn(a, key);
    const std::string in_b = valueIn(b, key);
    if (in_a != in_b) text += "; " + key + ": " + in_a + " and " + in_b;
  }
  return text;
}

/// What the node under test used in all shards, where their clients told.
void mergeUsage(const std::vector<Part>& parts, Info& merged) {
  double cpu_time = 0.0;
  std::uint64_t peak_memory = 0;
  for (const Part& part : parts) {
    const auto time = part.info.find(kNodeCpuTime);
    if (time != part.info.end()) cpu_time += pcrb::parseDouble(time->second).value_or(0.0);
    const auto peak = part.info.find(kNodePeakMemory);
    if (peak == part.info.end()) continue;
    peak_memory = std::max(peak_memory, pcrb::parseUnsigned(peak->second).value_or(0));
  }
  if (cpu_time > 0.0) merged[kNodeCpuTime] = pcrb::formatShortest(cpu_time);
  if (peak_memory > 0) merged[kNodePeakMemory] = std::to_string(peak_memory);
}

/// Compares each shard with all before it, so that clouds are compared among all that used them.
Info requireOneConfiguration(const std::vector<Part>& parts) {
  Info merged = parts.front().info;
  for (const Part& part : parts) {
    const std::string text = differences(merged, part.info);
    if (!text.empty()) {
      throw pcrb::StoreError(part.name() + ": found another configuration than in " +
                             parts.front().name() + ", expected the same" + text);
    }
    merged.insert(part.info.begin(), part.info.end());
  }
  mergeUsage(parts, merged);
  return merged;
}

/// Each of the shards 0/N … (N − 1)/N, once.
void requireEveryShard(const std::vector<Part>& parts) {
  const std::int64_t shards = parts.front().shards;
  std::map<std::int64_t, std::string> folders;
  for (const Part& part : parts) {
    if (part.shards != shards) {
      throw pcrb::StoreError(part.name() + ": found a part of " + std::to_string(part.shards) +
                             ", expected one of " + std::to_string(shards) + " as in " +
                             parts.front().name());
    }
    const auto [other, is_new] = folders.emplace(part.shard, part.folder);
    if (!is_new) {
      throw pcrb::StoreError(part.name() + ": found the shard that is in " + other->second +
                             " too, expected every shard once");
    }
  }
  std::string missing;
  for (std::int64_t i = 0; i < shards; ++i) {
    if (folders.count(i) == 0) missing += " " + std::to_string(i) + "/" + std::to_string(shards);
  }
  if (!missing.empty()) throw pcrb::StoreError("expected every shard, missing are" + missing);
}

Info mergedInfo(Info info, const std::vector<Part>& parts, std::size_t problems) {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  info["shard"] = "0/1";
  info["secret"] = pcrb::Secret::draw().toHex();
  info["created"] = pcrb::formatShortest(std::chrono::duration<double>(now).count());
  info["problems"] = std::to_string(problems);
  info[kMergedFrom] = std::to_string(parts.size()) + " shards";
  return info;
}

void requireReplaceable(const std::string& folder) {
  if (!fs::exists(folder + "/results.sqlite")) return;
  const pcrb::ResultsStore store(folder, pcrb::ResultsStore::Access::kReadOnly);
  if (store.runInfo().count(kMergedFrom) > 0) return;
  throw pcrb::StoreError(store.path() + ": found a run that no merge made, expected a free folder");
}

std::string writeRun(const std::string& folder, const std::vector<Part>& parts, const Info& info) {
  pcrb::ResultsStore store(folder, pcrb::ResultsStore::Access::kReadWrite);
  std::vector<pcrb::Result> results;
  std::vector<pcrb::Session> sessions;
  for (const Part& part : parts) {
    results.insert(results.end(), part.results.begin(), part.results.end());
    sessions.insert(sessions.end(), part.sessions.begin(), part.sessions.end());
  }
  store.setRunInfo(mergedInfo(info, parts, results.size()));
  store.addAll(results);
  std::stable_sort(sessions.begin(), sessions.end(),
                   [](const auto& a, const auto& b) { return a.started < b.started; });
  for (const pcrb::Session& session : sessions) {
    store.beginSession(session.started, session.host, session.pid);
    if (session.ended) store.endSession(*session.ended);
  }
  store.exportCsv();
  const std::string summary = formatSummary(pcrb::summarize(results));
  pcrb::writeFileAtomically(folder + "/summary.txt", summary);
  return summary;
}

std::string describeDefects(const std::vector<Part>& parts) {
  std::string defects;
  for (const Part& part : parts) {
    const std::string silence = describeSilence(part.results);
    if (!silence.empty()) defects += part.name() + ": " + silence + "\n";
  }
  return defects;
}

}  // namespace

std::string describeSilence(const std::vector<pcrb::Result>& results) {
  if (std::any_of(results.begin(), results.end(), pcrb::isAnswered)) return "";
  return "the node under test never answered: found no reply to " + std::to_string(results.size()) +
         " problems, expected at least one";
}

MergeReport runMergeTool(const MergeOptions& options) {
  if (options.runs.empty())
    throw pcrb::InvalidParameter("found no run, expected the shards of one");
  std::vector<Part> parts;
  for (const auto& run : options.runs) parts.push_back(readPart(run));
  requireReplaceable(options.output);
  const Info info = requireOneConfiguration(parts);
  requireEveryShard(parts);
  for (const Part& part : parts) requireComplete(part);

  const ScratchFolder scratch(options.output + "/" + kScratch);
  const std::string summary = writeRun(scratch.path, parts, info);
  for (const char* leftover : {"results.sqlite-wal", "results.sqlite-shm"}) {
    fs::remove(options.output + "/" + leftover);
  }
  for (const char* file : {"results.sqlite", "results.csv", "summary.txt"}) {
    fs::rename(scratch.path + "/" + file, options.output + "/" + file);
  }
  return {summary, describeDefects(parts)};
}

}  // namespace pcrb_tools
