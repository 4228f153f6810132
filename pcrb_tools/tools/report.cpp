#include <iostream>
#include <tuple>

#include "common/tool_main.hpp"
#include "report/report_tool.hpp"

namespace pcrb_tools::report {
namespace {

void addOptions(CLI::App& app, ReportOptions& options,
                std::vector<std::tuple<double, double>>& recall) {
  app.add_option("runs", options.runs, "run folders: FOLDER, or NAME=FOLDER to name a method");
  app.add_option(
      "--import", options.imports,
      "result files of others, <method>_<sequence>_<kind>.csv, or of the paper's authors, "
      "<sequence>_<kind>_result.txt: FILE, or NAME=FILE to name a method");
  app.add_option("--trackers", options.trackers,
                 "output folders of score_poses --sequence: FOLDER, or NAME=FOLDER");
  app.add_option(
         "--format", options.format,
         "format of the imported files. ppcr: id,initial_misalignment,error; csv: columns of "
         "results.csv, error and problem_id at least")
      ->check(CLI::IsMember({"csv", "ppcr"}))
      ->capture_default_str();
  app.add_option("--output,-o", options.output, "folder to write to")->required();
  app.add_option("--title", options.title, "title of the page")->capture_default_str();
  app.add_option("--root", options.root, "folder of the data sets [what each run says]");
  app.add_option(
      "--ground-truth", options.ground_truth,
      "CSV file of evaluate_ground_truth: the floor of each sequence, for which its source "
      "clouds are read");
  app.add_option(
      "--recall", recall,
      "translation (m) and rotation (degrees) below which a problem counts as solved [four pairs]");
  app.add_option("--resamples", options.resamples, "number of resamples of the bootstrap")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
  app.add_option("--seed", options.seed, "seed of the bootstrap")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  app.add_flag("!--no-components", options.with_components,
               "leave out the errors along each axis, for which all clouds of a run are read");
  app.add_flag("!--no-figures", options.draw_figures,
               "leave out the PNG and PDF figures, which take most of the time");
}

}  // namespace

int run(int argc, char** argv) {
  CLI::App app("Compares runs: statistics, tests of differences, charts.");
  app.footer(
      "Writes to the output folder: index.html (one file, needs nothing else), summary.csv, "
      "tables/*.csv, report.md, report.tex, report.json, figures/*.png and *.pdf.\n"
      "Examples: report runs/icp runs/gicp --output report\n"
      "          report mine=runs/2024-05-01 --output report\n"
      "          report --import mine_plain_local.csv --format csv --output report");
  ReportOptions options;
  std::vector<std::tuple<double, double>> recall;
  addOptions(app, options, recall);
  return runTool(app, argc, argv, [&] {
    if (!recall.empty()) options.recall_limits.clear();
    for (const auto& [metres, degrees] : recall)
      options.recall_limits.emplace_back(metres, degrees);
    runReportTool(options);
    std::cout << options.output << "/index.html" << std::endl;
    return kSuccess;
  });
}

}  // namespace pcrb_tools::report
