#include "server/run_record.hpp"

#include <unistd.h>

#include <array>
#include <chrono>

#include "pcrb_core/io/atomic_file.hpp"
#include "pcrb_core/io/number.hpp"

namespace pcrb {

namespace {

constexpr const char* kMetricVersion = "1";
constexpr const char* kNodeCpuTime = "node_cpu_time_s";
constexpr const char* kNodePeakMemory = "node_peak_memory_bytes";

double now() {
  return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
}

std::string hostName() {
  std::array<char, 256> name{};
  return gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "unknown";
}

/// What must be the same whenever this run is resumed.
std::map<std::string, std::string> identity(const ServerParameters& parameters,
                                            const RunPlan& plan) {
  std::map<std::string, std::string> info = configuration(parameters);
  info["metric_version"] = kMetricVersion;
  for (const auto& [name, hash] : plan.problem_files) info["problem_file " + name] = hash;
  return info;
}

}  // namespace

RunRecord::RunRecord(const ServerParameters& parameters, const RunPlan& plan,
                     const std::optional<Secret>& secret)
    : folder_(parameters.run),
      store_(parameters.run, ResultsStore::Access::kReadWrite),
      info_(store_.runInfo()) {
  const auto expected = identity(parameters, plan);
  if (store_.count() == 0) {
    const bool is_new = info_.empty();
    secret_ = secret ? *secret : is_new ? Secret::draw() : Secret::fromHex(info_["secret"]);
    const std::string created = is_new ? formatShortest(now()) : info_["created"];
    info_ = expected;
    info_["secret"] = secret_.toHex();
    info_["code_version"] = PCRB_VERSION;
    info_["root"] = parameters.root;
    info_["created"] = created;
    info_["problems"] = std::to_string(plan.problems.size());
    for (const auto& [name, tool] : plan.drawn_by) info_["drawn_by " + name] = tool;
    store_.setRunInfo(info_);
  } else {
    requireSame(info_, expected);
    secret_ = Secret::fromHex(info_["secret"]);
    if (secret && secret->toHex() != secret_.toHex()) {
      throw StoreError(store_.path() + ": holds results with another key: give another folder");
    }
  }
  store_.beginSession(now(), hostName(), getpid());
}

RunRecord::~RunRecord() {
  try {
    store_.endSession(now());
  } catch (const Error&) {
    // A session without an end is what a full disk or a kill leaves, too.
  }
}

void RunRecord::requireSame(const std::map<std::string, std::string>& found,
                            const std::map<std::string, std::string>& expected) const {
  std::string differences;
  for (const auto& [key, value] : expected) {
    const auto there = found.find(key);
    const std::string before = there == found.end() ? "nothing" : "`" + there->second + "`";
    if (there != found.end() && there->second == value) continue;
    differences += "\n  " + key + ": the run has " + before + ", asked for `" + value + "`";
  }
  for (const auto& [key, value] : found) {
    const bool is_problem_file = key.rfind("problem_file ", 0) == 0;
    if (is_problem_file && expected.count(key) == 0) differences += "\n  " + key + ": not selected";
  }
  if (differences.empty()) return;
  throw StoreError(store_.path() +
                   ": holds a run of another configuration: give another ~run, or the"
                   " parameters of this one" +
                   differences);
}

void RunRecord::noteCloud(const std::string& name, const std::string& hash) {
  const auto [entry, is_new] = info_.emplace("cloud " + name, hash);
  if (is_new) {
    store_.updateRunInfo(entry->first, hash);
  } else if (entry->second != hash) {
    throw StoreError(store_.path() + ": " + entry->first +
                     ": the file has changed since this run used it");
  }
}

void RunRecord::noteClient(const std::string& name, const std::string& parameters) {
  const std::string& before = info_["client_parameters"];
  if (info_["client"] == name && before != parameters && store_.count() > 0) {
    throw StoreError(store_.path() + ": holds results of `" + name + "` with the parameters `" +
                     before + "`, found `" + parameters + "`: give another ~run, or those");
  }
  note("client", name);
  if (!parameters.empty()) note("client_parameters", parameters);
}

void RunRecord::noteUsage(double cpu_time, std::uint64_t peak_memory) {
  if (cpu_time > 0.0) {
    const double before = parseDouble(info_[kNodeCpuTime]).value_or(0.0);
    note(kNodeCpuTime, formatShortest(before + cpu_time));
  }
  const auto before = parseUnsigned(info_[kNodePeakMemory]).value_or(0);
  if (peak_memory > before) note(kNodePeakMemory, std::to_string(peak_memory));
}

void RunRecord::note(const std::string& key, const std::string& value) {
  if (info_[key] == value) return;
  info_[key] = value;
  store_.updateRunInfo(key, value);
}

void RunRecord::requireClient(const std::string& name) {
  const auto before = info_.find("client");
  if (before != info_.end() && before->second != name) {
    throw StoreError(store_.path() + ": holds results of `" + before->second + "`, asked for `" +
                     name + "`: give another folder");
  }
  noteClient(name, "");
}

void RunRecord::writeExports(const std::string& summary_text) {
  store_.exportCsv();
  writeFileAtomically(folder_ + "/summary.txt", summary_text);
}

}  // namespace pcrb
