#include "benchmarking/batch_tool.hpp"
#include "common/tool_main.hpp"
#include "report/report_tool.hpp"

int main(int argc, char** argv) {
  CLI::App app(
      "Runs the paper's experiments: icp, gicp, ndt, ppcr on local problems, ransac, fgr, teaser "
      "on "
      "global ones; then writes the report.");
  app.footer(
      "Each method has its run in <run>/<method>; <run>/report/index.html is the page. Started "
      "again "
      "with the same folder, whatever ended it before, it goes on. Exit status: 0 only if every "
      "problem of every method has its result.\n"
      "Example: run_paper --root ~/pcrb/data --run ~/pcrb/paper");
  pcrb_tools::PaperOptions options;
  app.add_option("--root", options.root, "folder of the data sets")->required();
  app.add_option("--run", options.run, "folder of the runs and the report")->required();
  app.add_option("--methods", options.methods,
                 "to run: some of the seven [all]; the report has all that are complete")
      ->check(CLI::IsMember(pcrb_tools::paperMethods()));
  app.add_option("--sequences", options.sequences,
                 "sequences, data sets, or data_set/sequence, separated by blanks")
      ->capture_default_str();
  app.add_option("--subset", options.subset,
                 "random problems per method, the same for all; 0 = all")
      ->check(CLI::Range(0, 100000000))
      ->capture_default_str();
  app.add_option("--seed", options.seed, "of the subset")
      ->check(CLI::Range(0, 2147483647))
      ->capture_default_str();
  app.add_option("--time-limit", options.time_limit, "s per problem")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--jobs", options.jobs,
                 "benchmarks at the same time; latencies are undisturbed with one only")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  pcrb_tools::ReportOptions report;
  app.add_flag("!--no-figures", report.draw_figures, "no PNG and PDF figures, the page only");
  options.write_report = [&report](const std::vector<std::string>& runs,
                                   const std::string& output) {
    report.runs = runs;
    report.output = output;
    runReportTool(report);
  };
  return pcrb_tools::runTool(app, argc, argv, [&] { return runPaperTool(options); });
}
