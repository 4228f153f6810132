#include "server/client_parameters.hpp"

#include <ros/param.h>

#include <chrono>
#include <locale>
#include <sstream>
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
                              const ShutdownNotice& shutdown, double limit) {
  constexpr auto kPollPeriod = std::chrono::milliseconds(20);
  const std::string client = record.client();
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(limit);
  while (publications.listeners().count(client) == 0) {
    if (shutdown.requested() || std::chrono::steady_clock::now() >= end) return;
    std::this_thread::sleep_for(kPollPeriod);
  }
  record.noteClient(client, parametersOf(client));
}

}  // namespace pcrb
