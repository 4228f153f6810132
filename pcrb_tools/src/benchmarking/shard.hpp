#pragma once

#include <cstddef>
#include <ios>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "benchmarking/child_process.hpp"
#include "benchmarking/log_notices.hpp"
#include "common/process.hpp"
#include "pcrb_core/io/atomic_file.hpp"
#include "pcrb_core/run/results_store.hpp"

namespace pcrb_tools {

/// What a batch's shards have in common.
struct ShardSettings {
  std::string run;  ///< folder of the whole run
  int shards = 1;
  std::vector<std::string> command;  ///< roslaunch with its arguments, but for `run` and `shard`
  std::string scratch;  ///< folder for logs and temporary files; none: with the results
  bool own_masters = true;
};

/// One part of a batch: a run folder of its own, worked on by a roslaunch with its own master.
///
/// Its folder is held by a kernel lock that the roslaunch inherits: after a kill of the parent the
/// next one waits for it until the last roslaunch has ended its nodes.
class Shard {
 public:
  Shard(std::shared_ptr<const ShardSettings> settings, int number);
  ~Shard();
  Shard(const Shard&) = delete;
  Shard& operator=(const Shard&) = delete;

  /// Takes the lock and starts; false if somebody else holds it.
  bool tryStart();

  /// Whether it was started and has not ended yet; frees the lock once it has.
  bool isRunning();

  /// Its roslaunch; -1 if there is none.
  pid_t pid() const { return process_ ? process_->pid() : -1; }

  /// Whether its roslaunch has ended, whatever is left of its nodes.
  bool hasEnded() { return !process_ || process_->ended(); }

  /// Asks for an orderly end.
  void interrupt(int signal);

  /// Problems with a result, and all; all is 0 where it is not known yet.
  std::size_t done();
  std::size_t total();
  bool isComplete();

  /// Sequence of its newest result; empty where there is none.
  std::string sequence();

  /// What its log has told people since the call before: a text each, which may have several lines.
  std::vector<std::string> news();

  /// What is wrong with the shard as it is now, or nothing: problems without a result, a node that
  /// never answered.
  std::string defect();

  std::string folder() const;
  std::string name() const;  ///< e.g. `shard 2/4`

  /// Who kept tryStart() from taking the lock.
  std::string lockHolder() const { return lock_ ? lock_->holder() : ""; }

 private:
  void open();
  void checkpointWal();
  std::string logFile() const;
  std::string lastError() const;

  std::shared_ptr<const ShardSettings> settings_;
  int number_;
  std::unique_ptr<pcrb::FileLock> lock_;
  std::unique_ptr<TemporaryFolder> tmpdir_;  ///< TMPDIR while it runs, unless settings name one
  std::unique_ptr<ReservedPort> port_;
  std::unique_ptr<ChildProcess> process_;
  std::unique_ptr<pcrb::ResultsStore> store_;  ///< for reading; none as long as it is not there
  std::size_t total_ = 0;
  std::optional<LogNotices> notices_;  ///< of the log of the newest start
  std::streamoff log_start_ = 0;       ///< where the log of the newest start begins
};

}  // namespace pcrb_tools
