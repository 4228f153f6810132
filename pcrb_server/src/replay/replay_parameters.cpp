#include <filesystem>
#include <set>

#include "pcrb_core/error.hpp"
#include "pcrb_server/node_parameters.hpp"
#include "replay/replay.hpp"

namespace pcrb {

const ParameterTable kReplayParameters{
    {"", "", "", "What is shown"},
    {"root", "", "", "folder in the common layout; with run: instead of the one that the run used"},
    {"sequence", "", "", "sequence, or data_set/sequence"},
    {"problems", "", "|local|global",
     "kind of the sequence's problems, shown instead of its scans; of a run: of the problems"},
    {"problem", "", "", "official ids of problems, separated by blanks; empty = all"},
    {"run", "", "", "folder of a run, shown instead of a sequence"},
    {"rate", "2", "Hz", "scenes per second"},
    {"loop", "false", "", "begin again after the last scene"},
    {"autostart", "true", "", "start without the service ~start"},
    {"keep_alive", "false", "", "stay after the last scene, for viewers that come later"},
    {"map_frame", "map", "", "frame of the map"},
    {"", "", "", "Of a sequence"},
    {"map_file", "", "",
     "cloud in the sequence's frame (a name in its folder or an absolute path) instead of the map "
     "that grows"},
    {"exclude", "", "", "files that are no scans"},
    {"map_leaf", "0", "m", "edge of the growing map's voxels, 0 = the data set's"},
    {"map_points", "200000", "", "limit of the growing map, beyond which voxels double"},
    {"publish_ground_truth", "true", "",
     "false: only what a node under test may see, the map file, then the initial pose, then the "
     "scans in their sensor's frame",
     "truth"},
    {"scan_frame", "pcrb_scan", "", "frame of the scan without ground truth"},
    {"base_frame", "base_link", "",
     "frame of the robot's body, on tf the parent of the scan without ground truth; empty: none"},
    {"map_settle", "1", "s", "time from the map to the initial pose"},
    {"initialpose_settle", "0.1", "s", "time from the initial pose to the first scan"},
    {"stamps_file", "", "",
     "list of which scan was published when, written at the end, for score_poses --scans"},
    {"", "", "", "Of a run"},
    {"sequences", "all", "", "sequences, data sets or data_set/sequence, separated by blanks"},
    {"order", "finished", "finished|worst|best", "order of the problems"},
};

namespace {

constexpr double kMinRate = 1e-3;  // Hz
constexpr double kMaxRate = 1e3;
constexpr int kMaxMapPoints = 20'000'000;

/// Folder of a sequence's clouds.
///
/// @param word  `data_set/sequence`, or the sequence where only one data set has one of that name.
/// @throws InvalidParameter  if there is none, or more than one (naming them).
std::string findSequenceFolder(const std::string& root, const std::string& word) {
  namespace fs = std::filesystem;
  if (!fs::is_directory(root)) {
    throw InvalidParameter("root: found `" + root + "`, expected an existing folder");
  }
  std::set<std::string> found;
  if (word.find('/') != std::string::npos) {
    if (fs::is_directory(root + "/" + word)) found.insert(root + "/" + word);
  } else {
    for (const auto& data_set : fs::directory_iterator(root)) {
      const fs::path folder = data_set.path() / word;
      if (fs::is_directory(folder)) found.insert(folder.string());
    }
  }
  if (found.size() == 1) return *found.begin();
  std::string list;
  for (const auto& folder : found) list += " " + folder;
  throw InvalidParameter("sequence: found `" + word +
                         "`, expected the folder of one sequence below " + root +
                         (list.empty() ? ": there is none of that name" : ":" + list));
}

void readSequence(NodeParameters& reader, const std::string& root, const std::string& word,
                  ReplayParameters& parameters) {
  SequenceOptions& sequence = parameters.sequence;
  reader.check([&] { sequence.folder = findSequenceFolder(root, word); });
  const std::string map = reader.string("map_file");
  const std::filesystem::path path(map);
  if (!map.empty()) {
    sequence.map_file = path.is_absolute() ? map : sequence.folder + "/" + map;
    if (!std::filesystem::is_regular_file(sequence.map_file)) {
      reader.addMistake("~map_file: found `" + sequence.map_file + "`, expected a cloud's file");
    }
  }
  sequence.excluded = reader.words("exclude");
  sequence.map_leaf = reader.number("map_leaf", 0.0, 1e3);
  sequence.map_points = static_cast<std::size_t>(reader.integer("map_points", 1, kMaxMapPoints));
  sequence.publish_ground_truth = reader.boolean("publish_ground_truth");
  sequence.map_frame = reader.string("map_frame");
  sequence.scan_frame = reader.string("scan_frame");
  sequence.base_frame = reader.string("base_frame");
  sequence.map_settle = reader.number("map_settle", 0.0, 1e3);
  sequence.initialpose_settle = reader.number("initialpose_settle", 0.0, 1e3);
  parameters.stamps_file = reader.path("stamps_file");
}

void readProblems(NodeParameters& reader, const std::string& root, const std::string& word,
                  const std::string& kind, ReplayParameters& parameters) {
  parameters.subject = ReplayParameters::Subject::kProblems;
  ProblemSelection& selection = parameters.problems.configuration.selection;
  selection.root = root;
  selection.sequences = {word};
  selection.kinds = {kindFromString(kind)};
  parameters.problems.ids = reader.words("problem");
  parameters.problems.map_frame = reader.string("map_frame");
}

void readRun(NodeParameters& reader, const std::string& root, const std::string& kind,
             ReplayParameters& parameters) {
  parameters.subject = ReplayParameters::Subject::kRun;
  parameters.run.root = root;
  parameters.run.sequences = reader.words("sequences");
  if (!kind.empty()) parameters.run.kind = kindFromString(kind);
  parameters.run.ids = reader.words("problem");
  const std::string order = reader.choice("order");
  if (order == "worst") parameters.run.order = RunOptions::Order::kWorst;
  if (order == "best") parameters.run.order = RunOptions::Order::kBest;
  parameters.run.map_frame = reader.string("map_frame");
}

}  // namespace

ReplayParameters readReplayParameters() {
  NodeParameters reader(kReplayParameters);
  ReplayParameters parameters;
  const std::string root = reader.path("root");
  const std::string sequence = reader.string("sequence");
  parameters.run.run = reader.path("run");
  const std::string kind = reader.choice("problems");
  if (sequence.empty() == parameters.run.run.empty()) {
    reader.addMistake("~sequence or ~run: expected one of the two");
  } else if (!parameters.run.run.empty()) {
    readRun(reader, root, kind, parameters);
  } else if (root.empty()) {
    reader.addMistake("~root: must be given with ~sequence");
  } else if (!kind.empty()) {
    readProblems(reader, root, sequence, kind, parameters);
  } else {
    readSequence(reader, root, sequence, parameters);
  }
  parameters.rate = reader.number("rate", kMinRate, kMaxRate);
  parameters.loop = reader.boolean("loop");
  parameters.autostart = reader.boolean("autostart");
  parameters.keep_alive = reader.boolean("keep_alive");
  if (parameters.loop && !parameters.stamps_file.empty()) {
    reader.addMistake("~stamps_file: cannot be written with ~loop, which has no end");
  }
  reader.finish();
  return parameters;
}

std::unique_ptr<Playback> makePlayback(const ReplayParameters& parameters) {
  switch (parameters.subject) {
    case ReplayParameters::Subject::kSequence:
      return playSequence(parameters.sequence);
    case ReplayParameters::Subject::kProblems:
      return playProblems(parameters.problems);
    case ReplayParameters::Subject::kRun:
      return playRun(parameters.run);
  }
  throw Error("replay: unknown subject");
}

}  // namespace pcrb
