// What stands before a roslaunch that a program starts: all that the roslaunch started ends with
// it, and it ends with that program, even if that is killed. A roslaunch that ends while it starts
// forgets its master.

#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include "benchmarking/child_process.hpp"

namespace {

constexpr std::chrono::milliseconds kPoll{50};
constexpr std::chrono::seconds kPatience{30};  // roslaunch's own is 15 s, then 2 s

volatile std::sig_atomic_t newest_signal = 0;

void note(int signal) { newest_signal = signal; }

/// Waits for what has ended; whether the command has, and its status as a shell has it.
bool hasEnded(pid_t command, int& status) {
  bool has_ended = false;
  int found = 0;
  for (pid_t ended = 0; (ended = waitpid(-1, &found, WNOHANG)) > 0;) {
    if (ended != command) continue;  // an orphan of its
    has_ended = true;
    status = WIFSIGNALED(found) ? 128 + WTERMSIG(found) : WEXITSTATUS(found);
  }
  return has_ended;
}

/// Passes signals on until the command has ended, or does not heed them.
int guard(pid_t command) {
  using Clock = std::chrono::steady_clock;
  auto end = Clock::time_point::max();
  int status = 128 + SIGKILL;
  while (!hasEnded(command, status) && Clock::now() < end) {
    if (const int signal = newest_signal; signal != 0) {
      newest_signal = 0;
      kill(command, signal);
      if (end == Clock::time_point::max()) end = Clock::now() + kPatience;
    }
    std::this_thread::sleep_for(kPoll);
  }
  pcrb_tools::endDescendants({});
  return status;
}

/// The command, with a roslaunch that lies beside this program in place of the one in PATH: it is
/// more patient.
std::vector<std::string> withOwnRoslaunch(std::vector<std::string> command) {
  namespace fs = std::filesystem;
  const fs::path own = fs::read_symlink("/proc/self/exe").parent_path() / "roslaunch";
  if (command.front() == "roslaunch" && fs::exists(own)) command.front() = own.string();
  return command;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fputs(
        "usage: guard_launch COMMAND...: all that the command started ends with it, and it with "
        "the program that started this\n",
        stderr);
    return 2;
  }
  for (const int caught : {SIGINT, SIGTERM}) std::signal(caught, note);
  pcrb_tools::becomeSubreaper();
  pcrb::ProgramStart start;
  try {
    start.command = withOwnRoslaunch({argv + 1, argv + argc});
    return guard(pcrb::startProgram(start));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "guard_launch: %s\n", error.what());
    return 1;
  }
}
