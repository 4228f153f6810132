#include "batch/child_process.hpp"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>

#include "pcrb_core/error.hpp"

extern char** environ;

namespace pcrb_tools {
namespace {

std::vector<std::string> makeEnvironment(const ChildOptions& options) {
  std::vector<std::string> variables;
  for (char** entry = environ; *entry != nullptr; ++entry) {
    const std::string variable = *entry;
    const std::string name = variable.substr(0, variable.find('='));
    if (options.environment.count(name) == 0) variables.push_back(variable);
  }
  for (const auto& [name, value] : options.environment) {
    if (value) variables.push_back(name + "=" + *value);
  }
  return variables;
}

std::vector<char*> pointersTo(std::vector<std::string>& texts) {
  std::vector<char*> pointers;
  for (std::string& text : texts) pointers.push_back(text.data());
  pointers.push_back(nullptr);
  return pointers;
}

/// Between fork and exec: only what is safe after a fork.
[[noreturn]] void becomeProgram(char* const* command, char* const* environment, int log, int kept,
                                pid_t parent) {
  setpgid(0, 0);
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (getppid() != parent) _exit(1);  // the parent died before it could be watched
  const int null = open("/dev/null", O_RDONLY);
  dup2(null, STDIN_FILENO);
  dup2(log, STDOUT_FILENO);
  dup2(log, STDERR_FILENO);
  if (kept >= 0) fcntl(kept, F_SETFD, 0);
  environ = const_cast<char**>(environment);
  execvp(command[0], command);
  constexpr int kNotFound = 127;  // as a shell says it
  dprintf(STDERR_FILENO, "cannot start %s: %s\n", command[0], std::strerror(errno));
  _exit(kNotFound);
}

}  // namespace

ChildProcess::ChildProcess(const ChildOptions& options) {
  const int log = open(options.log.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  if (log < 0) throw pcrb::InvalidFile(options.log, std::strerror(errno));
  std::vector<std::string> command = options.command;
  std::vector<std::string> variables = makeEnvironment(options);
  const std::vector<char*> arguments = pointersTo(command);
  const std::vector<char*> environment = pointersTo(variables);
  const pid_t parent = getpid();
  pid_ = fork();
  if (pid_ == 0) {
    becomeProgram(arguments.data(), environment.data(), log, options.inherited_descriptor, parent);
  }
  const int error = errno;
  close(log);
  if (pid_ < 0) {
    throw pcrb::Error("cannot start " + command.front() + ": " + std::strerror(error));
  }
}

ChildProcess::~ChildProcess() {
  if (ended()) return;
  kill(-pid_, SIGKILL);
  while (waitpid(pid_, nullptr, 0) < 0 && errno == EINTR) {
  }
}

bool ChildProcess::ended() {
  if (!ended_) ended_ = waitpid(pid_, nullptr, WNOHANG) != 0;
  return ended_;
}

void ChildProcess::signal(int number) {
  if (!ended()) kill(pid_, number);
}

}  // namespace pcrb_tools
