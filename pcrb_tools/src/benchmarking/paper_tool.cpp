#include <algorithm>
#include <array>
#include <filesystem>
#include <iostream>
#include <string>
#include <vector>

#include "benchmarking/batch_tool.hpp"
#include "common/tool_main.hpp"
#include "pcrb_core/error.hpp"
#include "pcrb_core/io/number.hpp"
#include "pcrb_core/io/text.hpp"
#include "pcrb_core/run/results_store.hpp"
#include "pcrb_core/run/run_info.hpp"

namespace pcrb_tools {
namespace {

struct Experiment {
  std::string method;
  std::string kind;
  bool is_own = false;  ///< a method of the user's plugin, or the user's client
};

/// The paper gives global methods the global problems, without an initial guess.
const std::array<Experiment, 7> kExperiments{{{"icp", "local"},
                                              {"gicp", "local"},
                                              {"ndt", "local"},
                                              {"ppcr", "local"},
                                              {"ransac", "global"},
                                              {"fgr", "global"},
                                              {"teaser", "global"}}};

/// What a reader may want beside them: the paper's baselines as they were probably run, NDT with
/// cells that work, and nothing at all (docs/methods.md).
const std::array<Experiment, 7> kBaselines{{{"icp_pcl", "local"},
                                            {"gicp_pcl", "local"},
                                            {"ndt_pcl", "local"},
                                            {"ndt_1m", "local"},
                                            {"ndt_coarse_to_fine", "local"},
                                            {"ppcr_text", "local"},
                                            {"do_nothing", "both"}}};

Experiment experimentOf(const std::string& method, const PaperOptions& options) {
  const auto is_it = [&](const Experiment& e) { return e.method == method; };
  const auto* found = std::find_if(kExperiments.begin(), kExperiments.end(), is_it);
  if (found != kExperiments.end()) return *found;
  const auto* baseline = std::find_if(kBaselines.begin(), kBaselines.end(), is_it);
  if (baseline != kBaselines.end()) return *baseline;
  if (!options.plugin.empty() || !options.client.empty()) return {method, options.kind, true};
  throw pcrb::InvalidParameter(
      "found method `" + method +
      "`, expected icp, gicp, ndt, ppcr, ransac, fgr or teaser, one of the baselines (icp_pcl, "
      "gicp_pcl, ndt_pcl, ndt_1m, ndt_coarse_to_fine, ppcr_text, do_nothing), or a plugin or "
      "a client that has it");
}

std::vector<Experiment> chosen(const PaperOptions& options) {
  if (!options.client.empty() && !options.plugin.empty()) {
    throw pcrb::InvalidParameter("--client and --plugin: found both, expected one of them");
  }
  std::vector<Experiment> experiments;
  if (options.methods.empty()) experiments = {kExperiments.begin(), kExperiments.end()};
  for (const std::string& method : options.methods) {
    const bool is_new = std::none_of(experiments.begin(), experiments.end(),
                                     [&](const Experiment& e) { return e.method == method; });
    if (is_new) experiments.push_back(experimentOf(method, options));
  }
  const bool has_own = std::any_of(experiments.begin(), experiments.end(),
                                   [](const Experiment& e) { return e.is_own; });
  if (!options.client.empty() && !has_own) experiments.push_back({"client", options.kind, true});
  return experiments;
}

BatchOptions batchOf(const PaperOptions& options, const Experiment& experiment) {
  BatchOptions batch;
  batch.run = options.run + "/" + experiment.method;
  batch.jobs = options.jobs;
  batch.arguments = {"root:=" + options.root,
                     "sequences:=" + pcrb::joined(options.sequences, " "),
                     "kind:=" + experiment.kind,
                     "subset:=" + std::to_string(options.subset),
                     "seed:=" + std::to_string(options.seed),
                     "time_limit:=" + pcrb::formatShortest(options.time_limit)};
  if (experiment.is_own && !options.client.empty()) {
    batch.arguments.push_back("client_command:=" + options.client);
    return batch;
  }
  batch.arguments.push_back("method:=" + experiment.method);
  if (!experiment.is_own) return batch;
  batch.arguments.push_back("plugin:=" + options.plugin);
  if (!options.parameters.empty()) batch.arguments.push_back("parameters:=" + options.parameters);
  return batch;
}

/// Whether a run is there and every problem has its result.
bool isComplete(const std::string& run) {
  if (!std::filesystem::exists(run + "/results.sqlite")) return false;
  const pcrb::ResultsStore store(run, pcrb::ResultsStore::Access::kReadOnly);
  const auto planned = pcrb::RunInfo::read(store).problems;
  return planned && *planned == store.count();
}

/// The complete runs of all experiments, those of earlier calls too, and of the user's own methods.
std::vector<std::string> completeRuns(const PaperOptions& options,
                                      const std::vector<Experiment>& experiments,
                                      const std::vector<std::string>& failed) {
  std::vector<std::string> methods = paperMethods();
  for (const Experiment& baseline : kBaselines) methods.push_back(baseline.method);
  for (const Experiment& experiment : experiments) {
    if (experiment.is_own) methods.push_back(experiment.method);
  }
  std::vector<std::string> runs;
  for (const std::string& method : methods) {
    const std::string run = options.run + "/" + method;
    const bool has_failed = std::find(failed.begin(), failed.end(), method) != failed.end();
    if (!has_failed && isComplete(run)) runs.push_back(run);
  }
  return runs;
}

}  // namespace

std::vector<std::string> paperMethods() {
  std::vector<std::string> methods;
  for (const Experiment& experiment : kExperiments) methods.push_back(experiment.method);
  return methods;
}

int runPaperTool(const PaperOptions& options) {
  std::vector<std::string> failed;
  const std::vector<Experiment> experiments = chosen(options);
  for (const Experiment& experiment : experiments) {
    std::cout << experiment.method << ", " << experiment.kind << " problems:" << std::endl;
    if (runBatchTool(batchOf(options, experiment)) != kSuccess) {
      failed.push_back(experiment.method);
    }
  }
  const std::vector<std::string> runs = completeRuns(options, experiments, failed);
  if (!runs.empty()) {
    options.write_report(runs, options.run + "/report");
    std::cout << "report: " << options.run << "/report/index.html" << std::endl;
  }
  if (failed.empty()) return kSuccess;
  std::cerr << "not complete, and not in the report:";
  for (const std::string& method : failed) std::cerr << " " << method;
  std::cerr << std::endl;
  return kFailure;
}

}  // namespace pcrb_tools
