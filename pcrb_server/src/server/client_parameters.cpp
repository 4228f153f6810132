#include "server/client_parameters.hpp"

#include <ros/param.h>

#include <chrono>
#include <locale>
#include <set>
#include <sstream>
#include <string>
#include <thread>

namespace pcrb {

std::string parametersOf(const std::string& node) {
  XmlRpc::XmlRpcValue value;
  if (!ros::param::get(node, value)) return "";
  std::ostringstream text;
  text.imbue(std::locale::classic());
  value.write(text);
  return text.str();
}

void checkClientOfFinishedRun(RunRecord& record, const Publications& publications,
                              const ShutdownRequest& shutdown, double limit) {
  constexpr auto kPollPeriod = std::chrono::milliseconds(20);
  const std::set<std::string> clients = record.clients();
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(limit);
  while (!shutdown.requested() && std::chrono::steady_clock::now() < end) {
    for (const auto& name : publications.listeners()) {
      if (clients.count(name) > 0) return record.noteClient(name, parametersOf(name));
    }
    std::this_thread::sleep_for(kPollPeriod);
  }
}

}  // namespace pcrb
