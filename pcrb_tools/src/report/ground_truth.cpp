#include "report/ground_truth.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "pcrb_core/error.hpp"
#include "pcrb_core/io/file_bytes.hpp"
#include "pcrb_core/io/number.hpp"
#include "pcrb_core/io/text.hpp"

namespace pcrb_tools {

std::vector<GroundTruth> readGroundTruth(const std::string& path) {
  constexpr const char* kExpected = "columns data_set, sequence, mean and stddev";
  const pcrb::FileBytes file(path);
  pcrb::LineReader lines(file.text(), path);
  std::vector<std::string> header, row;
  if (!pcrb::nextCsvRow(lines, header)) throw pcrb::InvalidFile(path, 1, "nothing", kExpected);
  std::array<std::size_t, 4> places{};
  const std::array<const char*, 4> names{"data_set", "sequence", "mean", "stddev"};
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto found = std::find(header.begin(), header.end(), names[i]);
    if (found == header.end()) lines.fail("no column `" + std::string(names[i]) + "`", kExpected);
    places[i] = static_cast<std::size_t>(found - header.begin());
  }
  const auto length = [&](std::string_view field) {
    const auto value = pcrb::parseDouble(field);
    if (!value || !std::isfinite(*value) || *value < 0.0) {
      lines.fail(pcrb::inQuotes(field), "a length in m");
    }
    return *value;
  };
  std::vector<GroundTruth> accuracies;
  while (pcrb::nextCsvRow(lines, row)) {
    if (row.size() != header.size()) {
      lines.fail(std::to_string(row.size()) + " fields", std::to_string(header.size()));
    }
    if (row[places[2]].empty() && row[places[3]].empty()) continue;  // no pair could be aligned
    accuracies.push_back(
        {row[places[0]], row[places[1]], length(row[places[2]]), length(row[places[3]])});
  }
  return accuracies;
}

}  // namespace pcrb_tools
