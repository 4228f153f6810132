// What stands before a node in a launch file (launch-prefix) whose end is the launch's: roslaunch's
// `required` calls every end a death, in red, that of a finished run too. Before the node starts,
// it refuses what roslaunch takes without a word: arguments that the launch file does not have.

#include <ros/package.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "benchmarking/batch_tool.hpp"

namespace {

volatile std::sig_atomic_t is_ended_by_launch = 0;

/// The signals of a launch that ends reach the node, too, which is in the same process group.
void note(int) { is_ended_by_launch = 1; }

/// The node's status as a shell has it.
int waitFor(pid_t node) {
  int status = 0;
  while (waitpid(node, &status, 0) < 0 && errno == EINTR) {
  }
  return WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
}

std::vector<std::string> commandLine(pid_t process) {
  std::ifstream file("/proc/" + std::to_string(process) + "/cmdline");
  std::vector<std::string> words;
  for (std::string word; std::getline(file, word, '\0');) words.push_back(word);
  return words;
}

/// Whether it is a path of a launch file of pcrb_launch; a user's own may pass on what it likes.
bool isOfSuite(const std::string& path) {
  std::error_code not_there;
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  return std::filesystem::equivalent(folder, ros::package::getPath("pcrb_launch"), not_there);
}

/// @throws pcrb::InvalidParameter  if a roslaunch of one launch file of pcrb_launch was given an
///                                 argument that it does not have.
void requireKnownArguments(pid_t roslaunch) {
  pcrb_tools::BatchOptions given;
  given.launch.clear();
  std::string package;
  for (const std::string& word : commandLine(roslaunch)) {
    if (word.find(":=") != std::string::npos) {
      if (word.front() != '_') given.arguments.push_back(word);
    } else if (std::filesystem::path(word).extension() == ".launch") {
      if (!given.launch.empty()) return;
      given.launch = word;
    } else if (given.launch.empty()) {
      package = word;
    }
  }
  if (given.arguments.empty() || given.launch.empty()) return;
  if (package == "pcrb_launch" || isOfSuite(given.launch)) pcrb_tools::requireKnownArguments(given);
}

/// The folder of logs of the launch, as it tells its nodes; empty where it does not.
std::filesystem::path logFolder(char** command) {
  const std::string name = "__log:=";
  for (; *command != nullptr; ++command) {
    const std::string word = *command;
    if (word.rfind(name, 0) == 0)
      return std::filesystem::path(word.substr(name.size())).parent_path();
  }
  return {};
}

/// Says why the launch ends, unless another of its nodes has: one of them makes a file beside their
/// logs.
void say(const std::string& text, pid_t roslaunch, char** command) {
  const auto folder = logFolder(command);
  const auto path = folder / ("refused_launch-" + std::to_string(roslaunch) + ".log");
  std::FILE* const log = folder.empty() ? nullptr : std::fopen(path.c_str(), "wx");
  if (log == nullptr && !folder.empty() && errno == EEXIST) return;
  std::fprintf(stderr, "%s\n", text.c_str());
  if (log == nullptr) return;
  std::fprintf(log, "%s\n", text.c_str());
  std::fclose(log);
}

}  // namespace

int main(int argc, char** argv) {
  const bool if_failed = argc > 1 && std::strcmp(argv[1], "--if-failed") == 0;
  char** const command = argv + (if_failed ? 2 : 1);
  if (command[0] == nullptr) {
    std::fputs(
        "usage: ends_launch [--if-failed] COMMAND...: ends the roslaunch that started it when the "
        "command ends\n",
        stderr);
    return 2;
  }
  const pid_t roslaunch = getppid();
  try {
    requireKnownArguments(roslaunch);
  } catch (const std::exception& error) {
    say(error.what(), roslaunch, command);
    kill(roslaunch, SIGINT);
    return 2;
  }
  for (const int caught : {SIGINT, SIGTERM}) std::signal(caught, note);
  const pid_t node = fork();
  if (node == 0) {
    for (const int caught : {SIGINT, SIGTERM}) std::signal(caught, SIG_DFL);
    execvp(command[0], command);
    std::fprintf(stderr, "cannot start %s: %s\n", command[0], std::strerror(errno));
    _exit(127);
  }
  const int status = node < 0 ? 127 : waitFor(node);
  if (is_ended_by_launch != 0 || (if_failed && status == 0)) return status;
  const std::string name = std::string(command[0]).substr(std::string(command[0]).rfind('/') + 1);
  if (status != 0)
    std::fprintf(stderr, "%s ended with status %d, so the launch ends\n", name.c_str(), status);
  if (getppid() == roslaunch) kill(roslaunch, SIGINT);
  return status;
}
