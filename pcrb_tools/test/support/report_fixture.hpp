#pragma once

#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "pcrb_core/io/csv.hpp"
#include "pcrb_core/io/file_bytes.hpp"
#include "pcrb_core/run/results_store.hpp"
#include "report/report_tool.hpp"
#include "run/some_results.hpp"
#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"

namespace pcrb_tools {

inline std::string read(const std::string& path) {
  return std::string(pcrb::FileBytes(path).text());
}

using Rows = std::vector<std::map<std::string, std::string>>;

inline Rows readCsv(const std::string& path) {
  const std::string text = read(path);
  pcrb::LineReader lines(text, path);
  std::vector<std::string> header, fields;
  pcrb::nextCsvRow(lines, header);
  Rows rows;
  while (pcrb::nextCsvRow(lines, fields)) {
    rows.emplace_back();
    for (std::size_t i = 0; i < header.size(); ++i) rows.back()[header[i]] = fields.at(i);
  }
  return rows;
}

/// Makes runs and result files, and a report of them in its own folder.
class ReportTest : public ::testing::Test {
 protected:
  void SetUp() override {
    options_.output = folder_.file("report");
    options_.resamples = 200;
    options_.draw_figures = false;
  }

  /// A run of 20 pairs of `plain`, with ids like the published ones, with two perturbations each:
  /// its errors are `error`, rising a little.
  std::string addRun(const std::string& name, double error, std::size_t unanswered = 0) {
    pcrb::ResultsStore store(folder_.file(name), pcrb::ResultsStore::Access::kReadWrite);
    store.setRunInfo({{"secret", "0123456789abcdef0123456789abcdef"}, {"seed", "7"}});
    for (std::size_t i = 0; i < 40; ++i) {
      pcrb::Result result = pcrb_test::fullResult("421552847" + std::to_string(1000 + i));
      result.source = "scan" + std::to_string(i / 2) + ".pcd";
      result.overlap = 0.4 + 0.01 * static_cast<double>(i);
      result.initial_misalignment = 1.0;
      result.error = error * (1.0 + 0.001 * static_cast<double>(i));
      if (i < unanswered) {
        result.outcome = pcrb::Outcome::kTimedOut;
        result.reason = "found \"3\" points,\nexpected 10";
        result.error = result.initial_misalignment;
        result.position.reset();
        result.orientation.reset();
        result.covariance.reset();
      }
      store.add(result);
    }
    return folder_.file(name);
  }

  std::string addFile(const std::string& name, const std::string& text) {
    std::ofstream(folder_.file(name)) << text;
    return folder_.file(name);
  }

  template <typename... Texts>
  void expectImportFails(const std::string& text, const Texts&... expected) {
    options_.imports = {addFile("mine_yard_local.csv", text)};
    pcrb_test::expectError<pcrb::InvalidFile>([&] { writeReportData(options_); }, expected...);
  }

  pcrb_test::TemporaryFolder folder_;
  ReportOptions options_;
};

}  // namespace pcrb_tools
