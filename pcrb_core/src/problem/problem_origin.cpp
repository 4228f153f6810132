#include "pcrb_core/problem/problem_origin.hpp"

#include <filesystem>
#include <string_view>

#include "pcrb_core/io/file_bytes.hpp"
#include "pcrb_core/io/text_rows.hpp"

namespace pcrb {
namespace {

constexpr std::string_view kTool = "tool: ";

}  // namespace

std::string toolThatDrew(const std::string& problem_file, const std::string& hash) {
  const std::string side_file = problem_file + ".yaml";
  if (!std::filesystem::is_regular_file(side_file)) return {};
  const FileBytes bytes(side_file);
  LineReader lines(bytes.text(), side_file);
  std::string tool;
  bool is_of_this_file = false;
  for (std::string_view line; lines.next(line);) {
    if (line.substr(0, kTool.size()) == kTool) tool = trimmed(line.substr(kTool.size()));
    is_of_this_file = is_of_this_file || line == "output_blake2b: " + hash;
  }
  return is_of_this_file ? tool : std::string();
}

}  // namespace pcrb
