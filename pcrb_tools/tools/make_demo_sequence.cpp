#include "pcrb_tools/demo_sequence.hpp"
#include "pcrb_tools/tool_main.hpp"

int main(int argc, char** argv) {
  CLI::App app(
      "Simulates a short sequence of scans of a hall and its registration problems, in the common "
      "layout: <root>/demo/hall/*.pcd, <root>/demo/hall_local.txt, hall_global.txt.");
  std::string root;
  pcrb_tools::DemoSequence demo;
  app.add_option("root", root, "folder of the data sets")->required();
  app.add_option("--seed", demo.seed, "of the scene, the noise and the problems")
      ->capture_default_str();
  app.add_option("--scans", demo.scans)->check(CLI::Range(4, 1000))->capture_default_str();
  app.add_option("--pairs", demo.pairs, "pairs of scans per list of problems")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  return pcrb_tools::runTool(app, argc, argv, [&] {
    pcrb_tools::makeDemoSequence(root, demo);
    return pcrb_tools::kSuccess;
  });
}
