#include "benchmarking/batch_tool.hpp"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <deque>
#include <filesystem>
#include <iostream>
#include <map>
#include <memory>
#include <set>
#include <thread>

#include "benchmarking/child_process.hpp"
#include "benchmarking/shard.hpp"
#include "common/process.hpp"
#include "common/progress.hpp"
#include "common/tool_main.hpp"
#include "pcrb_core/error.hpp"
#include "pcrb_core/io/text.hpp"
#include "pcrb_core/run/merge_runs.hpp"

namespace pcrb_tools {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kPoll{200};
constexpr std::chrono::seconds kLockLimit{30};  // longer than a roslaunch takes to end its nodes
constexpr std::chrono::seconds kInterruptLimit{25};  // roslaunch's own is 15 s, then 2 s
constexpr std::chrono::seconds kTerminateLimit{5};
constexpr std::size_t kLongestSubject = 24;  // letters

/// The shards that this process is to see to, each until it is complete or has failed.
class Batch {
 public:
  Batch(const std::shared_ptr<const ShardSettings>& settings, const BatchOptions& options);
  ~Batch();
  Batch(const Batch&) = delete;
  Batch& operator=(const Batch&) = delete;

  /// Says what is not as it should be with the shards.
  void run();

  bool hasDefects() const { return !defects_.empty(); }
  bool isComplete() const;

 private:
  void startSome();
  void reap();
  void endLeftNodes();
  void tellNews();
  void showProgress();
  void stop();
  bool waitForAll(std::chrono::seconds limit);

  std::vector<std::unique_ptr<Shard>> shards_;
  std::size_t jobs_;
  std::deque<Shard*> waiting_;
  std::vector<Shard*> running_;
  std::vector<std::string> defects_;
  std::map<std::string, const Shard*> told_;  ///< texts, and which shard has told each first
  std::string subject_;
  Clock::time_point start_ = Clock::now();
  Progress progress_;
};

/// What is benchmarked, for people who watch: the method or the node, as far as arguments say it,
/// and short enough for a line of a terminal.
std::string subjectOf(const BatchOptions& options) {
  for (const std::string prefix : {"client_command:=", "method:=", "node:=", "node_launch:="}) {
    for (const std::string& argument : options.arguments) {
      if (!pcrb::startsWith(argument, prefix)) continue;
      const std::string subject = argument.substr(prefix.size());
      return subject.size() <= kLongestSubject
                 ? subject
                 : "..." + subject.substr(subject.size() - kLongestSubject + 3);
    }
  }
  return "run";
}

Batch::Batch(const std::shared_ptr<const ShardSettings>& settings, const BatchOptions& options)
    : jobs_(static_cast<std::size_t>(options.jobs)),
      subject_(subjectOf(options)),
      progress_(subject_, "problems", 0) {
  becomeSubreaper();
  for (int i = 0; i < settings->shards; ++i) {
    if (!options.only || *options.only == i) {
      shards_.push_back(std::make_unique<Shard>(settings, i));
    }
  }
  for (const auto& shard : shards_) {
    progress_.keep(shard->done());
    if (!shard->isComplete()) waiting_.push_back(shard.get());
  }
}

Batch::~Batch() {
  stop();
  shards_.clear();
  endDescendants({});
}

void Batch::run() {
  while (!waiting_.empty() || !running_.empty()) {
    Interruption::check();
    startSome();
    std::this_thread::sleep_for(kPoll);
    reap();
    tellNews();
    showProgress();
  }
  progress_.rename(subject_);
  progress_.finish();
  for (const auto& shard : shards_) {
    const std::string defect = shard->defect();
    if (!defect.empty()) defects_.push_back(defect);
  }
  for (const auto& defect : defects_) std::cerr << defect << std::endl;
}

bool Batch::isComplete() const {
  return std::all_of(shards_.begin(), shards_.end(),
                     [](const auto& shard) { return shard->isComplete(); });
}

void Batch::startSome() {
  for (std::size_t turns = waiting_.size(); turns > 0 && running_.size() < jobs_; --turns) {
    Shard* const shard = waiting_.front();
    waiting_.pop_front();
    if (shard->tryStart()) {
      running_.push_back(shard);
    } else if (Clock::now() - start_ < kLockLimit) {
      waiting_.push_back(shard);  // what a killed batch left may be about to end
    } else {
      defects_.push_back(shard->name() + ": " + shard->lockHolder() + " is at work in " +
                         shard->folder());
    }
  }
}

/// Of a roslaunch that was killed, before others may take its shard for free.
void Batch::endLeftNodes() {
  std::set<pid_t> at_work;
  for (Shard* shard : running_) {
    if (!shard->hasEnded()) at_work.insert(shard->pid());
  }
  if (at_work.size() < running_.size()) endDescendants(at_work);
}

void Batch::reap() {
  endLeftNodes();
  const auto has_ended = [](Shard* shard) { return !shard->isRunning(); };
  running_.erase(std::remove_if(running_.begin(), running_.end(), has_ended), running_.end());
}

/// Shards tell much the same: what one has told is not told by another one.
void Batch::tellNews() {
  for (const auto& shard : shards_) {
    for (const std::string& text : shard->news()) {
      if (told_.emplace(text, shard.get()).first->second == shard.get()) progress_.note(text);
    }
  }
}

void Batch::showProgress() {
  std::size_t done = 0;
  std::size_t total = 0;
  std::size_t largest = 0;
  for (const auto& shard : shards_) largest = std::max(largest, shard->total());
  for (const auto& shard : shards_) {
    done += shard->done();
    // Sizes are one apart at most, so this is nearly right before all are known.
    total += shard->total() > 0 ? shard->total() : largest;
  }
  const std::string sequence = running_.empty() ? "" : running_.front()->sequence();
  if (!sequence.empty()) progress_.rename(subject_ + ", " + sequence);
  progress_.set(done, total);
}

bool Batch::waitForAll(std::chrono::seconds limit) {
  for (const auto start = Clock::now(); Clock::now() - start < limit;) {
    reap();
    if (running_.empty()) return true;
    std::this_thread::sleep_for(kPoll);
  }
  return false;
}

void Batch::stop() {
  if (running_.empty()) return;
  for (Shard* shard : running_) shard->interrupt(SIGINT);
  if (waitForAll(kInterruptLimit)) return;
  for (Shard* shard : running_) shard->interrupt(SIGTERM);
  waitForAll(kTerminateLimit);
}

std::shared_ptr<const ShardSettings> makeSettings(const BatchOptions& options) {
  auto settings = std::make_shared<ShardSettings>();
  settings->run = options.run;
  settings->shards = numberOfShards(options);
  settings->command = launchCommand(options);
  settings->scratch = options.scratch;
  settings->own_masters = options.own_masters;
  if (!options.own_masters && settings->shards != 1) {
    throw pcrb::InvalidParameter("--master current: found " + std::to_string(settings->shards) +
                                 " shards, expected 1, for one master has room for one benchmark");
  }
  if (options.only && *options.only >= settings->shards) {
    throw pcrb::InvalidParameter("--only: found " + std::to_string(*options.only) +
                                 ", expected a shard below " + std::to_string(settings->shards));
  }
  return settings;
}

BatchOptions withAbsolutePaths(BatchOptions options) {
  const auto absolute = [](const std::string& path) {
    return std::filesystem::absolute(path).lexically_normal().string();
  };
  options.run = absolute(options.run);
  if (!options.scratch.empty()) options.scratch = absolute(options.scratch);
  return options;
}

}  // namespace

std::vector<std::string> launchArguments(int argc, char** argv) {
  std::vector<std::string> arguments;
  for (int i = 1; i < argc; ++i) {
    const std::string argument = withHomeFolder(argv[i]);
    const bool is_of_launch_file = argument.find(":=") != std::string::npos &&
                                   !pcrb::startsWith(argument, "__") &&
                                   !pcrb::startsWith(argument, ":=");
    if (is_of_launch_file) arguments.push_back(argument);
  }
  return arguments;
}

int runBatchTool(const BatchOptions& given) {
  const BatchOptions options = withAbsolutePaths(given);
  const auto settings = makeSettings(options);
  requireKnownArguments(options);
  std::filesystem::create_directories(options.run);
  noteConfiguration(options, settings->shards);
  const Interruption interruption;
  pcrb::MergeOptions merge{{}, options.run};
  for (int i = 0; i < settings->shards; ++i) merge.runs.push_back(Shard(settings, i).folder());
  Batch batch(settings, options);
  batch.run();
  if (!batch.isComplete()) {
    std::cerr << "the run is not complete; start this again with the same folder to go on"
              << std::endl;
  } else if (!options.only) {
    std::cout << pcrb::mergeRuns(merge).summary << std::flush;
  }
  return batch.hasDefects() ? kFailure : kSuccess;
}

}  // namespace pcrb_tools
