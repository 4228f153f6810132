#include "benchmarking/orphans.hpp"

#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <thread>

#include "pcrb_server/processes.hpp"

namespace pcrb_tools {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::seconds kPatience{5};
constexpr std::chrono::milliseconds kPoll{20};

}  // namespace

void adoptOrphans() { prctl(PR_SET_CHILD_SUBREAPER, 1); }

void endOrphans(const std::set<pid_t>& but) {
  const auto end = Clock::now() + kPatience;
  std::set<pid_t> told;
  while (true) {
    const auto orphans = pcrb::processesBelow(getpid(), but);
    if (orphans.empty()) return;
    const bool is_over = Clock::now() >= end;
    for (const pid_t orphan : orphans) {
      if (waitpid(orphan, nullptr, WNOHANG) == orphan) continue;
      if (told.insert(orphan).second) kill(orphan, SIGTERM);
      if (is_over) kill(orphan, SIGKILL);
    }
    std::this_thread::sleep_for(kPoll);
  }
}

}  // namespace pcrb_tools
