#include "benchmarking/child_process.hpp"

#include <sys/wait.h>

#include <cerrno>
#include <csignal>

namespace pcrb_tools {

ChildProcess::ChildProcess(const pcrb::ProgramStart& start) : pid_(pcrb::startProgram(start)) {}

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
