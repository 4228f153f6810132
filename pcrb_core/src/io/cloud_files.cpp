#include "pcrb_core/io/cloud_files.hpp"

#include <algorithm>
#include <filesystem>
#include <string_view>
#include <system_error>

#include "pcrb_core/error.hpp"

namespace pcrb {
namespace {

bool isDigit(char c) { return c >= '0' && c <= '9'; }

/// The run of digits, or the one other character, at the start of a text that is not empty.
std::string_view nextPart(std::string_view text) {
  std::size_t length = 1;
  while (isDigit(text[0]) && length < text.size() && isDigit(text[length])) ++length;
  return text.substr(0, length);
}

std::string_view withoutZeros(std::string_view digits) {
  return digits.substr(std::min(digits.find_first_not_of('0'), digits.size()));
}

int compareParts(std::string_view left, std::string_view right) {
  if (!isDigit(left[0]) || !isDigit(right[0])) return left.compare(right);
  const std::string_view a = withoutZeros(left);
  const std::string_view b = withoutZeros(right);
  if (a.size() != b.size()) return a.size() < b.size() ? -1 : 1;
  return a.compare(b);
}

}  // namespace

bool naturalLess(const std::string& left, const std::string& right) {
  std::string_view a = left;
  std::string_view b = right;
  while (!a.empty() && !b.empty()) {
    const std::string_view part_a = nextPart(a);
    const std::string_view part_b = nextPart(b);
    const int order = compareParts(part_a, part_b);
    if (order != 0) return order < 0;
    a.remove_prefix(part_a.size());
    b.remove_prefix(part_b.size());
  }
  if (a.empty() != b.empty()) return a.empty();
  return left < right;
}

std::vector<std::string> findClouds(const std::string& folder) {
  std::vector<std::string> names;
  std::error_code error;
  for (std::filesystem::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    const std::filesystem::path& path = entry->path();
    const std::string name = path.filename().string();
    if (path.extension() == ".pcd" && name.front() != '.') names.push_back(name);
  }
  if (error) throw InvalidFile(folder, "cannot list the folder: " + error.message());
  std::sort(names.begin(), names.end(), naturalLess);
  return names;
}

}  // namespace pcrb
