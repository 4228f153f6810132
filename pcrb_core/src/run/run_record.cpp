#include "pcrb_core/run/run_record.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>

#include "pcrb_core/io/atomic_file.hpp"
#include "pcrb_core/io/text.hpp"
#include "run/run_table.hpp"

namespace pcrb {

namespace {

std::string hostName() {
  std::array<char, 256> name{};
  return gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "unknown";
}

/// A line for each difference between what a run has (here) and what it was asked for (there).
std::string describeDifferences(const std::vector<RunInfo::Difference>& differences) {
  std::string text;
  for (const auto& [parameter, here, there] : differences) {
    text += "\n  " + parameter + ": ";
    text += !there ? "not selected"  // of a problem file that the run has
                   : "the run has " + inBackticks(here) + ", asked for " + inBackticks(there);
  }
  return text;
}

/// Names separated by blanks, and one more unless it is among them.
std::string withName(const std::string& names, const std::string& name) {
  const bool is_there = (" " + names + " ").find(" " + name + " ") != std::string::npos;
  return is_there ? names : names + " " + name;
}

}  // namespace

RunRecord::RunRecord(const std::string& folder, const RunConfiguration& configuration,
                     const RunPlan& plan, const std::optional<Secret>& secret)
    : folder_(folder),
      store_(folder, ResultsStore::Access::kReadWrite),
      info_(RunInfo::read(store_)),
      secret_(store_.count() == 0 ? begin(configuration, plan, secret)
                                  : resume(configuration, plan, secret)) {
  store_.beginSession(secondsSinceEpoch(), hostName(), getpid());
  session_ = std::to_string(store_.sessions().size());
}

const Secret& RunRecord::begin(const RunConfiguration& configuration, const RunPlan& plan,
                               const std::optional<Secret>& secret) {
  const RunInfo before = info_;
  info_ = RunInfo::of(configuration, plan);
  info_.secret = secret ? *secret : before.secret ? *before.secret : Secret::draw();
  info_.created = before.created.value_or(secondsSinceEpoch());
  saved_ = info_.write();
  store_.setRunInfo(saved_);
  return *info_.secret;
}

const Secret& RunRecord::resume(const RunConfiguration& configuration, const RunPlan& plan,
                                const std::optional<Secret>& secret) {
  saved_ = info_.write();
  const auto differences =
      info_.differences(RunInfo::of(configuration, plan), RunInfo::Scope::kResume);
  if (!differences.empty()) {
    throw StoreError(store_.path() +
                     ": holds a run of another configuration: give another folder, or the"
                     " parameters of this one" +
                     describeDifferences(differences));
  }
  if (!info_.secret) throw StoreError(store_.path() + ": found no secret in the run table");
  if (secret && secret->toHex() != info_.secret->toHex()) {
    throw StoreError(store_.path() + ": holds results with another key: give another folder");
  }
  return *info_.secret;
}

RunRecord::~RunRecord() {
  try {
    store_.endSession(secondsSinceEpoch());
  } catch (const Error&) {
    // A session without an end is what a full disk or a kill leaves, too.
  }
}

std::string RunRecord::publicId(const PlannedProblem& planned) const {
  return secret_.publicId(planned.subject() + " session " + session_);
}

void RunRecord::save() {
  for (const auto& [key, text] : info_.write()) {
    const auto [entry, is_new] = saved_.emplace(key, text);
    if (!is_new && entry->second == text) continue;
    store_.updateRunInfo(key, text);
    entry->second = text;
  }
}

void RunRecord::noteCloud(const std::string& name, const std::string& hash) {
  const auto [entry, is_new] = info_.clouds.emplace(name, hash);
  if (is_new) return save();
  if (entry->second == hash) return;
  throw StoreError(store_.path() + ": cloud " + name +
                   ": the file has changed since this run used it");
}

void RunRecord::noteClient(const std::string& name, const std::string& parameters) {
  if (!info_.client || store_.count() == 0) {
    info_.client = name;
    info_.client_parameters = parameters;
    return save();
  }
  const bool is_known_by_name =
      info_.configuration.under_test.empty() && info_.configuration.handshake == Handshake::kReady;
  RunInfo asked = info_;
  if (is_known_by_name) asked.client = name;
  asked.client_parameters = parameters;
  if (!info_.client_parameters) info_.client_parameters = "";  // as older runs have it for none
  const auto differences = info_.differences(asked, RunInfo::Scope::kClient);
  if (!differences.empty()) {
    throw StoreError(store_.path() +
                     ": holds results of another client: give another folder, or the client of"
                     " this one (its name may change in a run with ~under_test)" +
                     describeDifferences(differences));
  }
  info_.client = withName(*info_.client, name);
  save();
}

std::set<std::string> RunRecord::clients() const {
  const auto names = splitAtBlanks(info_.client.value_or(""));
  return {names.begin(), names.end()};
}

void RunRecord::noteUsage(double cpu_time, std::uint64_t peak_memory) {
  if (cpu_time <= 0.0 && peak_memory <= info_.node_peak_memory) return;
  info_.node_cpu_time += cpu_time;
  info_.node_peak_memory = std::max(info_.node_peak_memory, peak_memory);
  save();
}

void RunRecord::noteForeignReplies(std::uint64_t count) {
  if (count == 0) return;
  info_.foreign_replies += count;
  save();
}

void RunRecord::writeExports(const std::string& summary_text) {
  store_.exportCsv();
  writeFileAtomically(folder_ + "/summary.txt", summary_text);
}

}  // namespace pcrb
