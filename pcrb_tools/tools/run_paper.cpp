#include "benchmarking/batch_tool.hpp"
#include "common/tool_main.hpp"
#include "report/report_tool.hpp"

namespace {

void addOptions(CLI::App& app, pcrb_tools::PaperOptions& options) {
  app.add_option("--root", options.root, "folder of the data sets")->required();
  app.add_option("--run", options.run, "folder of the runs and the report")->required();
  app.add_option("--method,--methods", options.methods,
                 "methods to run, of the paper, baselines (icp_pcl, ndt_pcl, …, do_nothing), or of "
                 "your own; the report has all that are complete [the paper's seven]");
  app.add_option("--plugin", options.plugin, "shared library of the methods of your own");
  app.add_option("--parameters", options.parameters,
                 "YAML file of the parameters of the methods of your own");
  app.add_option("--client", options.client,
                 "command that starts a client of your own, in place of a method of this suite");
  app.add_option("--kind", options.kind, "kind of problems that methods of your own are given")
      ->check(CLI::IsMember({"local", "global", "both"}))
      ->capture_default_str();
  app.add_option("--sequences", options.sequences, "sequences, data sets or data_set/sequence")
      ->capture_default_str();
  app.add_option("--subset", options.subset,
                 "random problems per method, the same for all methods; 0 = all")
      ->check(CLI::Range(0, 100000000))
      ->capture_default_str();
  app.add_option("--seed", options.seed, "seed of the subset")
      ->check(CLI::Range(0, 2147483647))
      ->capture_default_str();
  app.add_option("--time-limit", options.time_limit, "seconds that one problem may take")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--jobs", options.jobs,
                 "benchmarks at the same time; they disturb each other's runtimes")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app(
      "Runs the paper's experiments, or some and a method of your own: icp, gicp, ndt, ppcr on "
      "local problems, ransac, fgr, teaser on global ones; then writes the report.");
  app.footer(
      "Each method has its run in <run>/<method>; <run>/report/index.html is the page. Started "
      "again "
      "with the same folder, whatever ended it before, it goes on. Exit status: 0 only if every "
      "problem of every method has its result.\n"
      "Example: run_paper --root ~/pcrb/data --run ~/pcrb/paper");
  pcrb_tools::PaperOptions options;
  addOptions(app, options);
  pcrb_tools::ReportOptions report;
  app.add_flag("!--no-figures", report.draw_figures,
               "leave out the PNG and PDF figures, which take most of the time");
  options.write_report = [&report](const std::vector<std::string>& runs,
                                   const std::string& output) {
    report.runs = runs;
    report.output = output;
    runReportTool(report);
  };
  return pcrb_tools::runTool(app, argc, argv, [&] { return runPaperTool(options); });
}
