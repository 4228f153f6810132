#include "bags/bag_tools.hpp"

#include <filesystem>
#include <functional>
#include <iostream>
#include <optional>
#include <vector>

#include "bags/problem_key.hpp"
#include "bags/scene_bag.hpp"
#include "common/process.hpp"
#include "common/progress.hpp"
#include "common/sequence_paths.hpp"
#include "common/tool_main.hpp"
#include "pcrb_core/datasets/cloud_file.hpp"
#include "pcrb_core/datasets/stamp.hpp"
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
pcrb::DerivedFile describeBag(const std::string& tool, const BagOptions& options,
                              const std::string& cloud_folder) {
  pcrb::DerivedFile bag(options.output, tool);
  bag.setParameter("period", pcrb::formatShortest(options.period));
  bag.setParameter("compress", trueOrFalse(options.compress));
  for (const std::string& name : pcrb::findClouds(cloud_folder)) {
    bag.addInput(cloud_folder + "/" + name);
  }
  return bag;
}

pcrb::DerivedFile describeBag(const SequenceBagOptions& options) {
  const pcrb::SequenceOptions& sequence = options.sequence;
  pcrb::DerivedFile bag = describeBag("sequence_to_bag", options.bag, sequence.folder);
  if (!sequence.map_file.empty()) bag.addInput(sequence.map_file);
  std::string excluded;
  for (const std::string& name : sequence.excluded) excluded += name + ' ';
  bag.setParameter("excluded", excluded);
  bag.setParameter("map_leaf", pcrb::formatShortest(sequence.map_leaf));
  bag.setParameter("map_points", std::to_string(sequence.map_points));
  bag.setParameter("truth", trueOrFalse(sequence.publish_ground_truth));
  bag.setParameter("frames", sequence.map_frame + ' ' + sequence.scan_frame);
  if (options.keeps_time) bag.setParameter("times", "of the names");
  return bag;
}

pcrb::DerivedFile describeBag(const ProblemsBagOptions& options, const pcrb::SequenceFiles& files) {
  const pcrb::ProblemsOptions& problems = options.problems;
  pcrb::DerivedFile bag = describeBag("problems_to_bag", options.bag, files.cloud_folder);
  bag.addInput(files.problem_file);
  const pcrb::RunConfiguration& configuration = problems.configuration;
  bag.setParameter("presentation", pcrb::toString(configuration.presentation.kind));
  bag.setParameter("upright", trueOrFalse(configuration.presentation.yaw_only));
  bag.setParameter("truth", trueOrFalse(problems.publish_ground_truth));
  bag.setParameter("subset", std::to_string(configuration.selection.subset));
  bag.setParameter("seed", std::to_string(configuration.selection.seed));
  bag.setParameter("frames", problems.map_frame + ' ' + problems.scan_frame);
  return bag;
}

/// Whether the bag and its companion need not be made again.
bool isComplete(const pcrb::DerivedFile& bag, bool force, const std::string& companion) {
  const bool is_there = companion.empty() || fs::is_regular_file(companion);
  if (is_there) return isKept(bag, force);
  if (!force && !bag.isUpToDate()) bag.requireReplaceable();
  return false;
}

/// When each scene is due, from the first one's on, s.
std::vector<double> regularTimes(std::size_t count, double period) {
  std::vector<double> times;
  for (std::size_t i = 0; i < count; ++i) times.push_back(period * static_cast<double>(i));
  return times;
}

/// The same as the sensor gave the scans.
std::vector<double> timesOfNames(const pcrb::SequenceOptions& sequence) {
  std::vector<double> times;
  std::optional<pcrb::Stamp> first, last;
  for (const std::string& name : pcrb::scansOf(sequence)) {
    const auto stamp = pcrb::stampOfFileName(name);
    const std::string path = sequence.folder + "/" + name;
    if (!stamp) {
      throw pcrb::InvalidFile(path, 0, "a name without a timestamp",
                              "one, to play scans at the sensor's rate (or --rate)");
    }
    if (last && *stamp <= *last) {
      throw pcrb::InvalidFile(path, 0, "a timestamp that is not later than the scan's before it",
                              "timestamps that increase");
    }
    if (!first) first = stamp;
    last = stamp;
    times.push_back(static_cast<double>(*stamp - *first) * 1e-9);
  }
  return times;
}

/// Plays everything once into the bag.
void writeBag(pcrb::Playback& playback, const BagOptions& options, const std::string& unit,
              const std::vector<double>& times,
              const std::function<void(const pcrb::Scene&)>& on_scene) {
  const Interruption interruption;
  SceneBag bag(options.output, options.compress);
  Progress progress(fs::path(options.output).filename().string(), unit, playback.size());
  for (std::size_t i = 0; i < playback.size(); ++i) {
    Interruption::check();
    const ros::Duration since_start(times.at(i));
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
  const pcrb::DerivedFile bag = describeBag(options);
  if (isComplete(bag, options.bag.force, options.scans)) return;
  const auto playback = pcrb::playSequence(options.sequence);
  std::string scans;
  const auto times = options.keeps_time ? timesOfNames(options.sequence)
                                        : regularTimes(playback->size(), options.bag.period);
  writeBag(*playback, options.bag, "scans", times,
           [&scans](const pcrb::Scene& scene) { appendScan(scans, scene); });
  if (!options.scans.empty()) pcrb::writeFileAtomically(options.scans, scans);
  bag.record();
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
  const pcrb::DerivedFile bag = describeBag(options, path.files);
  if (isComplete(bag, options.bag.force, options.key)) return;
  problems.secret = pcrb::Secret::draw();
  ProblemKey key{fs::path(path.files.problem_file).filename().string(),
                 pcrb::fileHash(path.files.problem_file),
                 problems.configuration.presentation,
                 selection.subset,
                 selection.seed,
                 problems.secret,
                 {}};
  const auto playback = pcrb::playProblems(problems);
  const auto times = regularTimes(playback->size(), options.bag.period);
  writeBag(*playback, options.bag, "problems", times, [&key](const pcrb::Scene& scene) {
    key.rows[static_cast<pcrb::Stamp>(scene.stamp.toNSec())] = {scene.problem->problem_id,
                                                                scene.name};
  });
  if (!options.key.empty()) pcrb::writeFileAtomically(options.key, formatProblemKey(key));
  bag.record();
}

}  // namespace pcrb_tools
