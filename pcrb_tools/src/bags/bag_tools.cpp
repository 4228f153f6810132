#include "bags/bag_tools.hpp"

#include <filesystem>
#include <functional>
#include <iostream>

#include "bags/problem_key.hpp"
#include "bags/scene_bag.hpp"
#include "common/interruption.hpp"
#include "common/problem_file_path.hpp"
#include "common/progress.hpp"
#include "common/provenance.hpp"
#include "pcrb_core/error.hpp"
#include "pcrb_core/io/atomic_file.hpp"
#include "pcrb_core/io/file_bytes.hpp"
#include "pcrb_core/io/number.hpp"
#include "pcrb_core/io/pcd.hpp"
#include "pcrb_core/problem/secret.hpp"
#include "pcrb_server/playback/scene.hpp"

namespace pcrb_tools {
namespace {

namespace fs = std::filesystem;

const char* trueOrFalse(bool value) { return value ? "true" : "false"; }

/// What the bag is made from, as far as both tools have it in common.
Provenance makeProvenance(const std::string& tool, const BagOptions& options,
                          const std::string& cloud_folder) {
  Provenance provenance(tool);
  provenance.setParameter("period", pcrb::formatShortest(options.period));
  provenance.setParameter("compress", trueOrFalse(options.compress));
  for (const std::string& name : pcrb::findClouds(cloud_folder)) {
    provenance.addInput(cloud_folder + "/" + name);
  }
  return provenance;
}

Provenance makeProvenance(const SequenceBagOptions& options) {
  const pcrb::SequenceOptions& sequence = options.sequence;
  Provenance provenance = makeProvenance("sequence_to_bag", options.bag, sequence.folder);
  if (!sequence.map_file.empty()) provenance.addInput(sequence.map_file);
  std::string excluded;
  for (const std::string& name : sequence.excluded) excluded += name + ' ';
  provenance.setParameter("excluded", excluded);
  provenance.setParameter("map_leaf", pcrb::formatShortest(sequence.map_leaf));
  provenance.setParameter("map_points", std::to_string(sequence.map_points));
  provenance.setParameter("truth", trueOrFalse(sequence.publish_ground_truth));
  provenance.setParameter("frames", sequence.map_frame + ' ' + sequence.scan_frame);
  return provenance;
}

Provenance makeProvenance(const ProblemsBagOptions& options, const pcrb::SequenceFiles& files) {
  const pcrb::ProblemsOptions& problems = options.problems;
  Provenance provenance = makeProvenance("problems_to_bag", options.bag, files.cloud_folder);
  provenance.addInput(files.problem_file);
  const pcrb::RunConfiguration& configuration = problems.configuration;
  provenance.setParameter("presentation", pcrb::toString(configuration.presentation.kind));
  provenance.setParameter("upright", trueOrFalse(configuration.presentation.yaw_only));
  provenance.setParameter("truth", trueOrFalse(problems.publish_ground_truth));
  provenance.setParameter("subset", std::to_string(configuration.selection.subset));
  provenance.setParameter("seed", std::to_string(configuration.selection.seed));
  provenance.setParameter("frames", problems.map_frame + ' ' + problems.scan_frame);
  return provenance;
}

bool isComplete(const Provenance& provenance, const BagOptions& options,
                const std::string& companion) {
  const bool is_there = companion.empty() || fs::is_regular_file(companion);
  if (!is_there || !provenance.isUpToDate(options.output)) {
    if (!options.force) Provenance::requireReplaceable(options.output);
    return false;
  }
  std::cerr << options.output << ": complete and unchanged, kept" << std::endl;
  return true;
}

/// Plays everything once into the bag.
void writeBag(pcrb::Playback& playback, const BagOptions& options, const std::string& unit,
              const std::function<void(const pcrb::Scene&)>& on_scene) {
  const Interruption interruption;
  SceneBag bag(options.output, options.compress);
  Progress progress(fs::path(options.output).filename().string(), unit, playback.size());
  for (std::size_t i = 0; i < playback.size(); ++i) {
    Interruption::check();
    const ros::Duration since_start(options.period * static_cast<double>(i));
    const pcrb::Scene scene = playback.next(ros::Time(kBagStart, 0) + since_start);
    bag.write(scene);
    on_scene(scene);
    progress.add();
  }
  bag.commit();
  progress.finish();
}

}  // namespace

void runSequenceBagTool(const SequenceBagOptions& options) {
  const Provenance provenance = makeProvenance(options);
  if (isComplete(provenance, options.bag, options.scans)) return;
  const auto playback = pcrb::playSequence(options.sequence);
  std::string scans;
  writeBag(*playback, options.bag, "scans",
           [&scans](const pcrb::Scene& scene) { appendScan(scans, scene); });
  if (!options.scans.empty()) pcrb::writeFileAtomically(options.scans, scans);
  provenance.record(options.bag.output);
}

void runProblemsBagTool(const ProblemsBagOptions& given) {
  ProblemsBagOptions options = given;
  pcrb::ProblemsOptions& problems = options.problems;
  if (problems.needsSecret() && options.key.empty()) {
    throw pcrb::InvalidParameter(
        "found no --key, expected a file: without it nobody could score what comes back from "
        "problems without truth, or with secretly turned scans");
  }
  const ProblemFilePath path = splitProblemFilePath(options.problem_file);
  problems.configuration.time_limit = options.bag.period;
  pcrb::ProblemSelection& selection = problems.configuration.selection;
  selection.root = path.root;
  selection.sequences = {path.files.data_set + "/" + path.files.sequence};
  selection.kinds = {path.files.kind};
  const Provenance provenance = makeProvenance(options, path.files);
  if (isComplete(provenance, options.bag, options.key)) return;
  problems.secret = pcrb::Secret::draw();
  ProblemKey key{fs::path(path.files.problem_file).filename().string(),
                 pcrb::fileHash(path.files.problem_file),
                 problems.configuration.presentation,
                 selection.subset,
                 selection.seed,
                 problems.secret,
                 {}};
  const auto playback = pcrb::playProblems(problems);
  writeBag(*playback, options.bag, "problems", [&key](const pcrb::Scene& scene) {
    key.rows[static_cast<pcrb::Stamp>(scene.stamp.toNSec())] = {scene.problem->problem_id,
                                                                scene.name};
  });
  if (!options.key.empty()) pcrb::writeFileAtomically(options.key, formatProblemKey(key));
  provenance.record(options.bag.output);
}

}  // namespace pcrb_tools
