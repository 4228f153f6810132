#include "verdict/launch_arguments.hpp"

#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <iterator>

#include "pcrb_core/io/text.hpp"

namespace pcrb {

std::vector<std::string> launchArguments(std::string_view command_line,
                                         std::string_view launch_file) {
  std::vector<std::string> names;
  bool is_its_file = false;
  while (!command_line.empty()) {
    const std::string_view word = command_line.substr(0, command_line.find('\0'));
    command_line.remove_prefix(std::min(word.size() + 1, command_line.size()));
    const std::size_t sign = word.find(":=");
    if (sign == std::string_view::npos) {
      is_its_file = is_its_file || word.substr(word.rfind('/') + 1) == launch_file;
    } else if (!startsWith(word, "_")) {  // __name and the like are ROS's
      names.emplace_back(word.substr(0, sign));
    }
  }
  return is_its_file ? names : std::vector<std::string>();
}

std::string commandLineOfParent() {
  std::ifstream file("/proc/" + std::to_string(getppid()) + "/cmdline", std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

}  // namespace pcrb
