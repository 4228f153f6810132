#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <locale>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "pcrb_core/parallel.hpp"
#include "simulation/sample_logs.hpp"

namespace pcrb_test {

/// Logs that take a moment to make: few scans, sparse.
inline pcrb_tools::simulation::LogOptions tinyLogs() {
  pcrb_tools::simulation::LogOptions options;
  options.size = {2, 24, 60, 2, 40, 30, 5, 8, 4, 3, 90};
  return options;
}

inline void makeLogs(const pcrb_tools::simulation::LogPlan& plan, const std::string& folder,
                     int threads = 1) {
  pcrb::parallelFor(plan.jobs.size(), threads, [&](std::size_t i) { plan.jobs[i].make(folder); });
}

inline std::string readText(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  EXPECT_TRUE(file) << path;
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

/// The lines of a file, without their ends.
inline std::vector<std::string> readLines(const std::filesystem::path& path) {
  std::istringstream text(readText(path));
  std::vector<std::string> lines;
  for (std::string line; std::getline(text, line);) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    lines.push_back(line);
  }
  return lines;
}

/// The numbers of a line, whatever separates them.
inline std::vector<double> numbersOf(std::string line) {
  for (char& letter : line) {
    if (letter == ',') letter = ' ';
  }
  std::istringstream text(line);
  text.imbue(std::locale::classic());
  return {std::istream_iterator<double>(text), std::istream_iterator<double>()};
}

/// Every file below a folder, by its path there.
inline std::map<std::string, std::string> readTree(const std::filesystem::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file()) continue;
    files[std::filesystem::relative(entry.path(), folder).string()] = readText(entry.path());
  }
  return files;
}

}  // namespace pcrb_test
