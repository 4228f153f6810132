#include "server/run_record.hpp"

#include <unistd.h>

#include <array>
#include <chrono>
#include <iterator>
#include <sstream>

#include "pcrb_core/io/atomic_file.hpp"
#include "pcrb_core/io/number.hpp"

namespace pcrb {

namespace {

constexpr const char* kMetricVersion = "1";
constexpr const char* kClient = "client";
constexpr const char* kClientParameters = "client_parameters";
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

/// The lines of a text that another one has not: of a method's parameters, those that differ.
std::string linesOnlyIn(const std::string& text, const std::string& other) {
  std::istringstream lines(text);
  std::string found;
  for (std::string line; std::getline(lines, line);) {
    const bool is_common = ("\n" + other + "\n").find("\n" + line + "\n") != std::string::npos;
    if (!is_common) found += (found.empty() ? "" : ", ") + line;
  }
  return found;
}

/// A line for each key that does not have the expected value.
std::string differencesOf(const std::map<std::string, std::string>& found,
                          const std::map<std::string, std::string>& expected) {
  std::string differences;
  for (const auto& [key, value] : expected) {
    const auto there = found.find(key);
    if (there != found.end() && there->second == value) continue;
    const std::string before = there == found.end() ? "" : there->second;
    differences += "\n  " + key + ": the run has " +
                   (there == found.end() ? "nothing" : "`" + linesOnlyIn(before, value) + "`") +
                   ", asked for `" + linesOnlyIn(value, before) + "`";
  }
  return differences;
}

/// Names separated by blanks, and one more unless it is among them.
std::string withName(const std::string& names, const std::string& name) {
  const bool is_there = (" " + names + " ").find(" " + name + " ") != std::string::npos;
  return is_there ? names : names + " " + name;
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
  session_ = std::to_string(store_.sessions().size());
}

RunRecord::~RunRecord() {
  try {
    store_.endSession(now());
  } catch (const Error&) {
    // A session without an end is what a full disk or a kill leaves, too.
  }
}

std::string RunRecord::publicId(const PlannedProblem& planned) const {
  return secret_.publicId(planned.subject() + " session " + session_);
}

void RunRecord::requireSame(const std::map<std::string, std::string>& found,
                            const std::map<std::string, std::string>& expected) const {
  std::string differences = differencesOf(found, expected);
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
  const auto known = info_.find(kClient);
  if (known == info_.end() || store_.count() == 0) {
    note(kClient, name);
    note(kClientParameters, parameters);
    return;
  }
  const bool is_known_by_name = info_["under_test"].empty() && info_["handshake"] == "ready";
  std::map<std::string, std::string> expected{{kClientParameters, parameters}};
  if (is_known_by_name) expected[kClient] = name;
  info_.emplace(kClientParameters, "");  // older runs have none for a client without any
  const std::string differences = differencesOf(info_, expected);
  if (!differences.empty()) {
    throw StoreError(store_.path() +
                     ": holds results of another client: give another folder, or the client of"
                     " this one (its name may change in a run with ~under_test)" +
                     differences);
  }
  note(kClient, withName(known->second, name));
}

std::set<std::string> RunRecord::clients() const {
  const auto known = info_.find(kClient);
  std::istringstream names(known == info_.end() ? "" : known->second);
  return {std::istream_iterator<std::string>(names), {}};
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
  const auto [entry, is_new] = info_.emplace(key, value);
  if (!is_new && entry->second == value) return;
  entry->second = value;
  store_.updateRunInfo(key, value);
}

void RunRecord::writeExports(const std::string& summary_text) {
  store_.exportCsv();
  writeFileAtomically(folder_ + "/summary.txt", summary_text);
}

}  // namespace pcrb
