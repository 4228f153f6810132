#include <CLI/CLI.hpp>

#include "common/tool_main.hpp"
#include "simulation/sample_logs.hpp"

namespace pcrb_tools::make_sample_logs {

int run(int argc, char** argv) {
  simulation::SampleLogsRequest request;
  CLI::App app{
      "Simulates short logs in the original formats of the four data sets, by ray casting: "
      "something to try everything on before the real logs are there."};
  app.add_option("--output", request.output, "folder for the logs, new or empty")->required();
  app.add_option("--seed", request.seed,
                 "seed of all that is random: the same gives the same bytes")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  app.add_option("--size", request.size,
                 "size of the logs: small (seconds), medium, or large (the sensors' density)")
      ->check(CLI::IsMember({"small", "medium", "large"}))
      ->capture_default_str();
  app.add_option("--data-set", request.data_sets, "data set to simulate, several if repeated")
      ->check(CLI::IsMember(request.data_sets))
      ->capture_default_str();
  app.add_option(
         "--ground-truth-error", request.ground_truth_error,
         "length that every ground-truth pose is moved by, m; ground_truth_error.csv says how")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  addThreadsOption(app, request.threads);
  app.footer("Example: make_sample_logs --output ~/sample_logs --seed 1");
  return runTool(app, argc, argv, [&request] {
    simulation::makeSampleLogs(request);
    return kSuccess;
  });
}

}  // namespace pcrb_tools::make_sample_logs
