#include "pcrb_server/process_tree.hpp"

#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <sstream>
#include <string>

#include "pcrb_core/io/number.hpp"

namespace pcrb {

namespace {

std::optional<pid_t> parentOf(pid_t pid) {
  std::ifstream file("/proc/" + std::to_string(pid) + "/stat");
  std::string line;
  if (!std::getline(file, line)) return std::nullopt;
  std::istringstream fields(line.substr(line.rfind(')') + 1));  // a name may hold anything
  char state = 0;
  pid_t parent = 0;
  fields >> state >> parent;
  return parent;
}

}  // namespace

std::vector<pid_t> processesBelow(pid_t root, const std::set<pid_t>& but) {
  std::multimap<pid_t, pid_t> children;
  for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
    const auto pid = parseInt(entry.path().filename().string());
    if (!pid || but.count(static_cast<pid_t>(*pid)) > 0) continue;
    if (const auto parent = parentOf(static_cast<pid_t>(*pid))) {
      children.emplace(*parent, static_cast<pid_t>(*pid));
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

}  // namespace pcrb
