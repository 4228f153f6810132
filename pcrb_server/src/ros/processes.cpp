#include "pcrb_server/processes.hpp"

#include <fcntl.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "pcrb_core/error.hpp"
#include "pcrb_core/io/number.hpp"

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

/// What the kernel says of a process, proc(5).
struct ProcessState {
  pid_t parent = 0;
  double cpu_time = 0.0;  ///< s, user and system
};

std::optional<ProcessState> stateOf(pid_t pid) {
  std::ifstream file("/proc/" + std::to_string(pid) + "/stat");
  std::string line;
  if (!std::getline(file, line)) return std::nullopt;
  std::istringstream fields(line.substr(line.rfind(')') + 1));  // a name may hold anything
  ProcessState state;
  char letter = 0;
  fields >> letter >> state.parent;
  std::string skipped;
  for (int field = 5; field < 14; ++field) fields >> skipped;
  double user = 0.0;
  double system = 0.0;
  if (!(fields >> user >> system)) return std::nullopt;
  state.cpu_time = (user + system) / static_cast<double>(sysconf(_SC_CLK_TCK));
  return state;
}

/// Bytes.
std::optional<std::uint64_t> peakMemory(pid_t pid) {
  std::ifstream file("/proc/" + std::to_string(pid) + "/status");
  for (std::string word; file >> word;) {
    std::uint64_t kibibytes = 0;
    if (word == "VmHWM:" && file >> kibibytes) return kibibytes * 1024;
  }
  return std::nullopt;
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

std::vector<pid_t> processesBelow(pid_t root, const std::set<pid_t>& excluded) {
  std::multimap<pid_t, pid_t> children;
  for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
    const auto pid = parseInt(entry.path().filename().string());
    if (!pid || excluded.count(static_cast<pid_t>(*pid)) > 0) continue;
    if (const auto state = stateOf(static_cast<pid_t>(*pid))) {
      children.emplace(state->parent, static_cast<pid_t>(*pid));
    }
  }
  std::vector<pid_t> found{root};
  for (std::size_t i = 0; i < found.size(); ++i) {
    const auto [first, last] = children.equal_range(found[i]);
    for (auto child = first; child != last; ++child) found.push_back(child->second);
  }
  found.erase(found.begin());
  return found;
}

std::optional<ProcessUsage> usageOf(pid_t pid) {
  const auto state = stateOf(pid);
  const auto memory = peakMemory(pid);
  if (!state || !memory) return std::nullopt;
  return ProcessUsage{state->cpu_time, *memory};
}

}  // namespace pcrb
