#include <map>

#include "common/tool_main.hpp"
#include "pcrb_core/parallel.hpp"
#include "preparation/sampling_tool.hpp"

int main(int argc, char** argv) {
  CLI::App app(
      "Draws registration problems from a sequence: pairs evenly over overlap, perturbations about "
      "the source's centroid, uniform in direction and magnitude.");
  app.footer(
      "Writes <sequence>_local.txt and <sequence>_global.txt beside the folder, with side files "
      "that "
      "record the seed. Needs the matrix of compute_overlap.\n"
      "Example: sample_problems ~/pcrb/planetary/p2at_met --map box_map.pcd");
  pcrb_tools::SamplingOptions options;
  options.threads = pcrb::processorCount();
  const std::map<std::string, std::vector<pcrb::Kind>> kinds{
      {"local", {pcrb::Kind::kLocal}},
      {"global", {pcrb::Kind::kGlobal}},
      {"both", {pcrb::Kind::kLocal, pcrb::Kind::kGlobal}}};
  const std::map<std::string, pcrb::BoundsSource> bounds{
      {"measured", pcrb::BoundsSource::kMeasured}, {"note", pcrb::BoundsSource::kNote}};
  std::string kind = "both";
  std::string bounds_name = "measured";
  app.add_option("folder", options.folder, "<root>/<data set>/<sequence>, a folder of .pcd files")
      ->required();
  app.add_option("--overlap", options.overlap, "the overlap matrix [<folder>_overlap.txt]");
  app.add_option("--kind", kind, "local, global or both [both]")->check(CLI::IsMember(kinds));
  app.add_option("--seed", options.seed)->check(CLI::NonNegativeNumber)->capture_default_str();
  app.add_option("--bounds", bounds_name,
                 "perturbation bounds of the four published data sets: those measured in the "
                 "published problem files, or those of upstream's note [measured]")
      ->check(CLI::IsMember(bounds));
  app.add_option("--map", options.map,
                 "pose every cloud against this map, without threshold and intervals");
  app.add_option("--sequence", options.sequence,
                 "name of the problems [the folder's; planetary_map with --map]");
  app.add_option("--exclude", options.excluded, "clouds to draw no pairs from");
  app.add_option("--threads", options.threads)->check(CLI::Range(1, 1024))->capture_default_str();
  app.add_flag("--force", options.force, "replace problem files that this tool did not make");
  return pcrb_tools::runTool(app, argc, argv, [&] {
    options.kinds = kinds.at(kind);
    options.bounds = bounds.at(bounds_name);
    runSamplingTool(options);
    return pcrb_tools::kSuccess;
  });
}
