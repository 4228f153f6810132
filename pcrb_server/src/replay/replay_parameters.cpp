#include "replay/replay_parameters.hpp"

#include <filesystem>

#include "pcrb_core/error.hpp"
#include "pcrb_server/node_parameters.hpp"
#include "pcrb_server/sequence_path.hpp"

namespace pcrb {

namespace {

constexpr double kMinRate = 1e-3;  // Hz
constexpr double kMaxRate = 1e3;
constexpr int kMaxMapPoints = 20'000'000;

void readSequence(NodeParameters& reader, const std::string& root, const std::string& word,
                  ReplayParameters& parameters) {
  SequenceOptions& sequence = parameters.sequence;
  reader.check([&] { sequence.folder = findSequenceFolder(root, word); });
  const std::string map = reader.string("map_file", "");
  const std::filesystem::path path(map);
  if (!map.empty()) {
    sequence.map_file = path.is_absolute() ? map : sequence.folder + "/" + map;
    if (!std::filesystem::is_regular_file(sequence.map_file)) {
      reader.addMistake("~map_file: found `" + sequence.map_file + "`, expected a cloud's file");
    }
  }
  sequence.excluded = reader.words("exclude", "");
  sequence.map_leaf = reader.number("map_leaf", 0.0, 0.0, 1e3);
  sequence.map_points =
      static_cast<std::size_t>(reader.integer("map_points", 200000, 1, kMaxMapPoints));
  sequence.truth = reader.boolean("truth", true);
  sequence.map_frame = reader.string("map_frame", "map");
  sequence.scan_frame = reader.string("scan_frame", "pcrb_scan");
  parameters.stamps_file = reader.path("stamps_file", "");
}

void readProblems(NodeParameters& reader, const std::string& root, const std::string& word,
                  const std::string& kind, ReplayParameters& parameters) {
  parameters.subject = ReplayParameters::Subject::kProblems;
  parameters.problems.root = root;
  parameters.problems.sequences = {word};
  parameters.problems.kinds = {kindFromString(kind)};
  parameters.problems.map_frame = reader.string("map_frame", "map");
}

void readRun(NodeParameters& reader, const std::string& root, ReplayParameters& parameters) {
  parameters.subject = ReplayParameters::Subject::kRun;
  parameters.run.root = root;
  parameters.run.sequences = reader.words("sequences", "all");
  const std::string order = reader.choice("order", "finished", {"finished", "worst", "best"});
  if (order == "worst") parameters.run.order = RunOptions::Order::kWorst;
  if (order == "best") parameters.run.order = RunOptions::Order::kBest;
  parameters.run.map_frame = reader.string("map_frame", "map");
}

}  // namespace

ReplayParameters readReplayParameters() {
  NodeParameters reader;
  ReplayParameters parameters;
  const std::string root = reader.path("root", "");
  const std::string sequence = reader.string("sequence", "");
  parameters.run.run = reader.path("run", "");
  const std::string kind = reader.choice("problems", "", {"", "local", "global"});
  if (sequence.empty() == parameters.run.run.empty()) {
    reader.addMistake("~sequence or ~run: expected one of the two");
  } else if (!parameters.run.run.empty()) {
    readRun(reader, root, parameters);
  } else if (root.empty()) {
    reader.addMistake("~root: must be given with ~sequence");
  } else if (!kind.empty()) {
    readProblems(reader, root, sequence, kind, parameters);
  } else {
    readSequence(reader, root, sequence, parameters);
  }
  parameters.rate = reader.number("rate", 2.0, kMinRate, kMaxRate);
  parameters.loop = reader.boolean("loop", false);
  parameters.autostart = reader.boolean("autostart", true);
  parameters.keep_alive = reader.boolean("keep_alive", false);
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
