#include "supervisor/supervised_command.hpp"

#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <thread>

#include "pcrb_core/error.hpp"
#include "pcrb_server/processes.hpp"

namespace pcrb {

namespace {

constexpr auto kReapPeriod = std::chrono::milliseconds(20);

/// All processes below this one.
std::vector<pid_t> descendants() { return processesBelow(getpid()); }

void signalAll(int signal) {
  for (const pid_t pid : descendants()) kill(pid, signal);
}

}  // namespace

SupervisedCommand::SupervisedCommand(std::vector<std::string> command)
    : SupervisedCommand(std::move(command), Patience()) {}

SupervisedCommand::SupervisedCommand(std::vector<std::string> command, Patience patience)
    : command_(std::move(command)), patience_(patience) {
  prctl(PR_SET_CHILD_SUBREAPER, 1);
}

SupervisedCommand::~SupervisedCommand() { stop(); }

void SupervisedCommand::start() {
  if (isRunning()) throw Error(command_.front() + ": runs already");
  ProgramStart start;
  start.command = command_;
  // It is that of the node which supervises, not of what it starts.
  start.environment["ROS_NAMESPACE"] = std::nullopt;
  pid_ = startProgram(start);
}

void SupervisedCommand::reap() {
  while (true) {
    const pid_t ended = waitpid(-1, nullptr, WNOHANG);
    if (ended <= 0) return;
    if (ended == pid_) pid_ = 0;
  }
}

bool SupervisedCommand::isRunning() {
  reap();
  return pid_ != 0;
}

bool SupervisedCommand::waitUntilGone(std::chrono::milliseconds limit) {
  const auto end = std::chrono::steady_clock::now() + limit;
  while (true) {
    reap();
    if (descendants().empty()) return true;
    if (std::chrono::steady_clock::now() >= end) return false;
    std::this_thread::sleep_for(kReapPeriod);
  }
}

void SupervisedCommand::stop() {
  reap();
  if (pid_ != 0) kill(-pid_, SIGINT);
  if (pid_ == 0) signalAll(SIGINT);  // the command is gone and cannot pass it on
  if (waitUntilGone(patience_.interrupt)) return;
  signalAll(SIGTERM);
  if (waitUntilGone(patience_.terminate)) return;
  do {
    signalAll(SIGKILL);
  } while (!waitUntilGone(kReapPeriod));
}

}  // namespace pcrb
