#include "benchmarking/child_process.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <string>
#include <thread>

#include "pcrb_core/error.hpp"
#include "pcrb_server/processes.hpp"

namespace pcrb_tools {
namespace {

constexpr std::chrono::seconds kTerminationLimit{5};
constexpr std::chrono::milliseconds kTerminationPoll{20};

}  // namespace

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

void becomeSubreaper() { prctl(PR_SET_CHILD_SUBREAPER, 1); }

void endDescendants(const std::set<pid_t>& spared) {
  const auto end = std::chrono::steady_clock::now() + kTerminationLimit;
  std::set<pid_t> terminated;
  while (true) {
    const auto descendants = pcrb::processesBelow(getpid(), spared);
    if (descendants.empty()) return;
    const bool is_over = std::chrono::steady_clock::now() >= end;
    for (const pid_t process : descendants) {
      if (waitpid(process, nullptr, WNOHANG) == process) continue;
      if (terminated.insert(process).second) kill(process, SIGTERM);
      if (is_over) kill(process, SIGKILL);
    }
    std::this_thread::sleep_for(kTerminationPoll);
  }
}

ReservedPort::ReservedPort() {
  socket_ = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  const int yes = 1;
  setsockopt(socket_, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof(yes));
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof(address);
  auto* const any = reinterpret_cast<sockaddr*>(&address);
  if (socket_ < 0 || bind(socket_, any, size) != 0 || getsockname(socket_, any, &size) != 0) {
    throw pcrb::Error(std::string("found no free TCP port on 127.0.0.1: ") + std::strerror(errno));
  }
  number_ = ntohs(address.sin_port);
}

ReservedPort::~ReservedPort() { close(socket_); }

}  // namespace pcrb_tools
