#include "supervisor/supervised_command.hpp"

#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <thread>

#include "pcrb_core/error.hpp"
#include "pcrb_server/process_tree.hpp"

extern char** environ;

namespace pcrb {

namespace {

constexpr auto kPollPeriod = std::chrono::milliseconds(20);
constexpr int kNotExecuted = 127;  // the shell's status for a command that cannot be run

/// All processes below this one.
std::vector<pid_t> descendants() { return processesBelow(getpid()); }

void signalAll(int signal) {
  for (const pid_t pid : descendants()) kill(pid, signal);
}

std::vector<char*> pointers(std::vector<std::string>& texts) {
  std::vector<char*> pointers;
  for (auto& text : texts) pointers.push_back(text.data());
  pointers.push_back(nullptr);
  return pointers;
}

/// A namespace is that of the node which supervises, not of what it starts.
std::vector<std::string> environmentWithoutNamespace() {
  std::vector<std::string> variables;
  for (char** variable = environ; *variable != nullptr; ++variable) {
    if (std::strncmp(*variable, "ROS_NAMESPACE=", 14) != 0) variables.emplace_back(*variable);
  }
  return variables;
}

/// What the new process does, with system calls alone: other threads may hold any lock.
[[noreturn]] void become(char* const* command, char* const* environment, pid_t parent) {
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  for (const int caught : {SIGINT, SIGTERM, SIGPIPE}) signal(caught, SIG_DFL);
  setpgid(0, 0);
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (getppid() == parent) execvpe(command[0], command, environment);
  _exit(kNotExecuted);
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
  std::vector<std::string> environment = environmentWithoutNamespace();
  const auto command = pointers(command_);
  const auto variables = pointers(environment);
  const pid_t parent = getpid();
  const pid_t pid = fork();
  if (pid == 0) become(command.data(), variables.data(), parent);
  if (pid < 0) throw Error(command_.front() + ": no new process: " + std::strerror(errno));
  setpgid(pid, pid);  // here too: stop() may come before the child gets to it
  pid_ = pid;
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
    std::this_thread::sleep_for(kPollPeriod);
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
  } while (!waitUntilGone(kPollPeriod));
}

}  // namespace pcrb
