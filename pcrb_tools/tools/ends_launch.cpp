// What stands before a node in a launch file (launch-prefix) whose end is the launch's: roslaunch's
// `required` calls every end a death, in red, that of a finished run too.

#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <string>

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
