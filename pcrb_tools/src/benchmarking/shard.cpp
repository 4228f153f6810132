#include "benchmarking/shard.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "pcrb_core/error.hpp"
#include "pcrb_core/io/number.hpp"
#include "pcrb_core/io/text.hpp"
#include "pcrb_core/run/merge_runs.hpp"
#include "pcrb_core/run/run_info.hpp"

namespace pcrb_tools {
namespace {

namespace fs = std::filesystem;

constexpr std::array<const char*, 6> kErrorPrefixes{
    "benchmark_server: ",  "localization_bridge: ", "node_supervisor: ",
    "registration_node: ", "cannot start",          "RLException"};

constexpr const char* kNoClient = "benchmark_server: no client called";

/// Whether roslaunch can write where it keeps files of its own: with HOME unset or read-only it
/// cannot, and would end without a word.
bool isRosHomeWritable() {
  const char* const given = std::getenv("ROS_HOME");
  const char* const home = std::getenv("HOME");
  if (given == nullptr && home == nullptr) return false;
  const fs::path ros_home = given != nullptr ? fs::path(given) : fs::path(home) / ".ros";
  const fs::path folder = fs::exists(ros_home) ? ros_home : ros_home.parent_path();
  return ::access(folder.c_str(), W_OK) == 0;
}

/// What lets nothing of a roslaunch outlive it or this process, however they end.
std::string guardProgram() {
  return (fs::read_symlink("/proc/self/exe").parent_path() / "guard_launch").string();
}

}  // namespace

Shard::Shard(std::shared_ptr<const ShardSettings> settings, int number)
    : settings_(std::move(settings)), number_(number) {}

Shard::~Shard() {
  process_.reset();
  lock_.reset();
}

std::string Shard::folder() const { return settings_->run + "/shards/" + std::to_string(number_); }

std::string Shard::name() const {
  return "shard " + std::to_string(number_) + "/" + std::to_string(settings_->shards);
}

std::string Shard::logFile() const { return folder() + "/roslaunch.log"; }

bool Shard::tryStart() {
  fs::create_directories(folder());
  lock_ = std::make_unique<pcrb::FileLock>(folder() + "/batch.lock");
  if (!lock_->isHeld()) return false;
  pcrb::ProgramStart start;
  start.command = settings_->command;
  start.command.insert(start.command.begin(), guardProgram());
  start.command.push_back("run:=" + folder());
  start.command.push_back("shard:=" + std::to_string(number_) + "/" +
                          std::to_string(settings_->shards));
  if (settings_->own_masters) {
    port_ = std::make_unique<ReservedPort>();
    start.environment = {{"ROS_MASTER_URI", "http://127.0.0.1:" + std::to_string(port_->number())},
                         {"ROS_IP", "127.0.0.1"},
                         {"ROS_HOSTNAME", std::nullopt},
                         {"ROS_NAMESPACE", std::nullopt}};
  }
  start.environment["ROS_LOG_DIR"] = folder() + "/log";
  if (settings_->scratch.empty()) {
    tmpdir_ = std::make_unique<TemporaryFolder>("pcrb_shard");
    start.environment["TMPDIR"] = tmpdir_->path();
    if (!isRosHomeWritable()) start.environment["ROS_HOME"] = tmpdir_->path();
  } else {
    const std::string scratch = settings_->scratch + "/shard_" + std::to_string(number_);
    fs::create_directories(scratch);
    for (const char* name : {"ROS_HOME", "TMPDIR"}) start.environment[name] = scratch;
    start.environment["ROS_LOG_DIR"] = scratch + "/log";
  }
  start.log = logFile();
  log_start_ = fs::exists(start.log) ? static_cast<std::streamoff>(fs::file_size(start.log)) : 0;
  notices_.emplace(start.log, log_start_);
  start.inherited_descriptor = lock_->descriptor();
  process_ = std::make_unique<ChildProcess>(start);
  return true;
}

bool Shard::isRunning() {
  if (!process_) return false;
  if (!process_->ended()) return true;
  process_.reset();
  port_.reset();
  checkpointWal();
  tmpdir_.reset();
  lock_.reset();
  return false;
}

/// The server that ended could not checkpoint its write-ahead log while the database was read
/// here.
void Shard::checkpointWal() {
  store_.reset();
  if (!fs::exists(folder() + "/results.sqlite")) return;
  try {
    const pcrb::ResultsStore store(folder(), pcrb::ResultsStore::Access::kReadWrite);
  } catch (const pcrb::StoreError&) {
    // Damaged, or a server that outlived its roslaunch is writing: both show when it is read.
  }
}

void Shard::interrupt(int signal) {
  if (process_) process_->signal(signal);
}

void Shard::open() {
  if (store_ && total_ > 0) return;
  try {
    store_ = std::make_unique<pcrb::ResultsStore>(folder(), pcrb::ResultsStore::Access::kReadOnly);
    total_ = pcrb::RunInfo::read(*store_).problems.value_or(0);
  } catch (const pcrb::StoreError&) {
    store_.reset();  // the server is about to make it, or to say in its log what is wrong with it
  }
}

std::size_t Shard::done() {
  open();
  return store_ ? store_->count() : 0;
}

std::size_t Shard::total() {
  open();
  return total_;
}

std::string Shard::sequence() {
  open();
  return store_ ? store_->newestSequence() : "";
}

std::vector<std::string> Shard::news() {
  return notices_ ? notices_->next(done() == 0) : std::vector<std::string>();
}

bool Shard::isComplete() { return total() > 0 && done() >= total(); }

std::string Shard::defect() {
  if (!isComplete()) {
    const std::string of = total_ == 0 ? "" : " of " + std::to_string(total_);
    return name() + ": " + std::to_string(done()) + of + " problems have a result" + lastError();
  }
  const std::string silence = pcrb::describeSilence(store_->results());
  return silence.empty() ? "" : name() + ": " + silence + "; see " + logFile();
}

/// What a node said on standard error before it gave up, as the suite's nodes say it: a line, and
/// those below it that are indented.
std::string Shard::lastError() const {
  std::ifstream log(logFile());
  log.seekg(log_start_);
  std::string line;
  std::string error;
  bool goes_on = false;
  while (std::getline(log, line)) {
    if (pcrb::startsWith(line, "\033[")) line.erase(0, line.find('m') + 1);  // roslaunch's colours
    const auto begins = [&line](const char* start) { return pcrb::startsWith(line, start); };
    const bool is_error = std::any_of(kErrorPrefixes.begin(), kErrorPrefixes.end(), begins);
    goes_on = is_error || (goes_on && begins("  "));
    if (is_error) error = line;
    if (goes_on && !is_error) error += ";" + line.substr(1);
  }
  if (pcrb::startsWith(error, kNoClient) && notices_) {
    const std::string wait = notices_->last("localization_bridge");
    if (!wait.empty()) error += "; localization_bridge: " + wait;
  }
  return error.empty() ? "; see " + logFile() : "; " + error + " (" + logFile() + ")";
}

}  // namespace pcrb_tools
