#include "common/tool_main.hpp"
#include "preparation/preparation_tools.hpp"

namespace pcrb_tools::build_map {

int run(int argc, char** argv) {
  CLI::App app(
      "Merges the clouds of a sequence, which are in the world frame, into a map: the centroid of "
      "the points in each voxel of a fixed grid.");
  app.footer(
      "Memory is bounded by the map, not by the sequence.\n"
      "Example: build_map ~/pcrb/planetary/box_met -o ~/pcrb/planetary/p2at_met/box_map.pcd");
  MapOptions options;
  app.add_option("folder", options.folder, "<root>/<data set>/<sequence>, a folder of .pcd files")
      ->required();
  app.add_option("-o,--output", options.output, "file of the map, .pcd")->required();
  app.add_option("--leaf", options.leaf, "edge of a voxel, m [the data set's]");
  app.add_option("--exclude", options.excluded, "names of clouds to leave out of the map");
  addThreadsOption(app, options.threads);
  app.add_flag("--force", options.force, "replace an output that this tool did not make");
  return runTool(app, argc, argv, [&] {
    runMapTool(options);
    return kSuccess;
  });
}

}  // namespace pcrb_tools::build_map
