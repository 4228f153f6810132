#include "pcrb_tools/paper_tool.hpp"

#include <algorithm>
#include <array>
#include <iostream>

#include "pcrb_core/error.hpp"
#include "pcrb_core/io/number.hpp"
#include "pcrb_tools/batch_tool.hpp"
#include "pcrb_tools/report/report_tool.hpp"
#include "pcrb_tools/tool_main.hpp"

namespace pcrb_tools {
namespace {

struct Experiment {
  const char* method;
  const char* kind;
};

/// The paper gives global methods the global problems, without an initial guess.
constexpr std::array<Experiment, 7> kExperiments{{{"icp", "local"},
                                                  {"gicp", "local"},
                                                  {"ndt", "local"},
                                                  {"ppcr", "local"},
                                                  {"ransac", "global"},
                                                  {"fgr", "global"},
                                                  {"teaser", "global"}}};

std::vector<Experiment> chosen(const std::vector<std::string>& methods) {
  if (methods.empty()) return {kExperiments.begin(), kExperiments.end()};
  std::vector<Experiment> experiments;
  for (const std::string& method : methods) {
    const auto* found = std::find_if(kExperiments.begin(), kExperiments.end(),
                                     [&](const Experiment& e) { return e.method == method; });
    if (found == kExperiments.end()) {
      throw pcrb::InvalidParameter("found method `" + method +
                                   "`, expected icp, gicp, ndt, ppcr, ransac, fgr or teaser");
    }
    experiments.push_back(*found);
  }
  return experiments;
}

BatchOptions batchOf(const PaperOptions& options, const Experiment& experiment) {
  BatchOptions batch;
  batch.run = options.run + "/" + experiment.method;
  batch.jobs = options.jobs;
  batch.arguments = {"root:=" + options.root,
                     "sequences:=" + options.sequences,
                     std::string("kind:=") + experiment.kind,
                     std::string("method:=") + experiment.method,
                     "subset:=" + std::to_string(options.subset),
                     "seed:=" + std::to_string(options.seed),
                     "time_limit:=" + pcrb::formatShortest(options.time_limit)};
  return batch;
}

}  // namespace

std::vector<std::string> paperMethods() {
  std::vector<std::string> methods;
  for (const Experiment& experiment : kExperiments) methods.emplace_back(experiment.method);
  return methods;
}

int runPaperTool(const PaperOptions& options) {
  ReportOptions report;
  report.output = options.run + "/report";
  report.draw_figures = options.draw_figures;
  std::string failed;
  for (const Experiment& experiment : chosen(options.methods)) {
    std::cout << experiment.method << ", " << experiment.kind << " problems:" << std::endl;
    const BatchOptions batch = batchOf(options, experiment);
    if (runBatchTool(batch) == kSuccess) {
      report.runs.push_back(batch.run);
    } else {
      failed += std::string(" ") + experiment.method;
    }
  }
  if (!report.runs.empty()) {
    runReportTool(report);
    std::cout << "report: " << report.output << "/index.html" << std::endl;
  }
  if (failed.empty()) return kSuccess;
  std::cerr << "not complete, and not in the report:" << failed << std::endl;
  return kFailure;
}

}  // namespace pcrb_tools
