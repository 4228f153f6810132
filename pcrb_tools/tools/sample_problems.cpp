#include "common/tool_main.hpp"
#include "preparation/preparation_tools.hpp"

namespace pcrb_tools::sample_problems {
namespace {

void addChoices(CLI::App& app, SamplingOptions& options) {
  using Kinds = std::vector<pcrb::Kind>;
  addChoice<Kinds>(app, "--kind", options.kinds,
                   {{"local", {pcrb::Kind::kLocal}},
                    {"global", {pcrb::Kind::kGlobal}},
                    {"both", {pcrb::Kind::kLocal, pcrb::Kind::kGlobal}}},
                   "kind of the problems: local, global or both [both]");
  addChoice<pcrb::BoundsSource>(
      app, "--bounds", options.bounds,
      {{"measured", pcrb::BoundsSource::kMeasured}, {"note", pcrb::BoundsSource::kNote}},
      "bounds of the perturbations of the four published data sets: measured in the "
      "published problem files, or of upstream's note [measured]");
  addChoice<pcrb::TopUp>(
      app, "--top-up", options.top_up,
      {{"even", pcrb::TopUp::kEven}, {"paper", pcrb::TopUp::kPaper}},
      "pairs that an interval of overlaps lacks: even, from the intervals with the "
      "fewest; paper, from all that are left [even]");
}

void addOptions(CLI::App& app, SamplingOptions& options) {
  app.add_option("folder", options.folder, "<root>/<data set>/<sequence>, a folder of .pcd files")
      ->required();
  app.add_option("--overlap", options.overlap, "file of the overlap matrix [<folder>_overlap.txt]");
  app.add_option("--seed", options.seed, "seed that the problems are drawn with")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  app.add_option(
      "--map", options.map,
      "name of a map that every cloud is posed against, without threshold and intervals");
  app.add_option("--sequence", options.sequence,
                 "name of the problems' sequence [the folder's; planetary_map with --map]");
  app.add_option("--exclude", options.excluded, "names of clouds to draw no pairs from");
  addThreadsOption(app, options.threads);
  app.add_flag("--force", options.force, "replace problem files that this tool did not make");
}

}  // namespace

int run(int argc, char** argv) {
  CLI::App app(
      "Draws registration problems from a sequence: pairs evenly over overlap, perturbations about "
      "the source's centroid, uniform in direction and magnitude.");
  app.footer(
      "Writes <sequence>_local.txt and <sequence>_global.txt beside the folder, with side files "
      "that "
      "record the seed. Needs the matrix of compute_overlap.\n"
      "Example: sample_problems ~/pcrb/planetary/p2at_met --map box_map.pcd");
  SamplingOptions options;
  addOptions(app, options);
  addChoices(app, options);
  return runTool(app, argc, argv, [&] {
    runSamplingTool(options);
    return kSuccess;
  });
}

}  // namespace pcrb_tools::sample_problems
