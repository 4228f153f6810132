#include "pcrb_server/start_program.hpp"

#include <fcntl.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>

#include "pcrb_core/error.hpp"

namespace pcrb {

namespace {

constexpr int kNotExecuted = 127;

std::vector<std::string> environmentOf(const ProgramStart& start) {
  std::vector<std::string> variables;
  for (char** entry = environ; *entry != nullptr; ++entry) {
    const std::string variable = *entry;
    const std::string name = variable.substr(0, variable.find('='));
    if (start.environment.count(name) == 0) variables.push_back(variable);
  }
  for (const auto& [name, value] : start.environment) {
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

/// What the new process does, with system calls alone: other threads may hold any lock.
///
/// @param log   open descriptor, or -1.
/// @param kept  descriptor to keep open, or -1.
[[noreturn]] void become(char* const* command, char* const* environment, int log, int kept,
                         pid_t parent) {
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  for (const int caught : {SIGINT, SIGTERM, SIGPIPE}) std::signal(caught, SIG_DFL);
  setpgid(0, 0);
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (getppid() != parent) _exit(kNotExecuted);  // it died before this could be told of it
  if (log >= 0) {
    dup2(open("/dev/null", O_RDONLY | O_CLOEXEC), STDIN_FILENO);
    dup2(log, STDOUT_FILENO);
    dup2(log, STDERR_FILENO);
  }
  if (kept >= 0) fcntl(kept, F_SETFD, 0);
  execvpe(command[0], command, environment);
  dprintf(STDERR_FILENO, "cannot start %s: %s\n", command[0], std::strerror(errno));
  _exit(kNotExecuted);
}

}  // namespace

pid_t startProgram(const ProgramStart& start) {
  std::vector<std::string> words = start.command;
  std::vector<std::string> variables = environmentOf(start);
  const std::vector<char*> command = pointersTo(words);
  const std::vector<char*> environment = pointersTo(variables);
  int log = -1;
  if (!start.log.empty()) {
    log = open(start.log.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
    if (log < 0) throw InvalidFile(start.log, std::strerror(errno));
  }
  const pid_t parent = getpid();
  const pid_t pid = fork();
  if (pid == 0) {
    become(command.data(), environment.data(), log, start.inherited_descriptor, parent);
  }
  const int error = errno;
  if (log >= 0) close(log);
  if (pid < 0) throw Error("cannot start " + words.front() + ": " + std::strerror(error));
  setpgid(pid, pid);  // here too: the group may be signalled before the program gets to it
  return pid;
}

}  // namespace pcrb
