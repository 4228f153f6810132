#include "server/server_parameters.hpp"

#include <algorithm>
#include <filesystem>

#include "pcrb_core/error.hpp"
#include "pcrb_server/message_conversion.hpp"
#include "pcrb_server/node_parameters.hpp"

namespace pcrb {

const ParameterTable kServerParameters{
    {"", "", "", "The run"},
    {"root", kRequired, "", "folder in the common layout, <root>/<data set>/<sequence>_<kind>.txt"},
    {"run", kRequired, "",
     "folder of the results; with results of the same configuration the run goes on"},
    {"under_test", "", "",
     "name of what is benchmarked; a run goes on only under the same, and with a client of the "
     "same "
     "private parameters and, if this is empty, of the same node name"},
    {"", "", "", "Problems"},
    {"sequences", "all", "", "sequences, data sets or data_set/sequence, separated by blanks"},
    {"kind", "local", "local|global|both", "kind of the problems"},
    {"subset", "0", "", "number of problems drawn over all sequences, 0 = all"},
    {"seed", "1", "", "seed of that draw"},
    {"shard", "0/1", "", "i/N: the i-th of N disjoint parts"},
    {"", "", "", "Protocol"},
    {"presentation", "registration", "registration|localization", "form of the problems"},
    {"time_limit", "30", "s", "time from a source's publication to its reply"},
    {"handshake", "ready", "ready|none",
     "client of a problem, the caller of the service `ready` or any subscriber of `problem`"},
    {"connect_limit", "60", "s", "time to wait for the first client"},
    {"ready_limit", "60", "s", "time to wait for `ready` of each further problem"},
    {"global_guess", "false", "", "initial guess for global problems, too"},
    {"yaw_only", "false", "",
     "localization without VIEWPOINT turns scans about z only; gives the tilt away", "upright"},
    {"audit", "false", "",
     "each target gets a secret motion of its own, and 95 % of each cloud's points are published "
     "in a secret order: a client's memory is of no use then"},
    {"results", "end", "end|live",
     "time at which `result` has errors, after the run or (for rviz and demos) at once, which "
     "tells a client how to do better with the same clouds and marks the run"},
    {"allow_skipped", "false", "", "skipped problems do not make the exit status 1"},
    {"autostart", "true", "", "start without the service ~start"},
    {"summary_hold_time", "5", "s",
     "time that the summary stays up at the end, unless its readers have left before", "linger"},
    {"debug", "false", "", "the truth, published on debug/*; marks the run"},
    {"", "", "", "Frames and resources"},
    {"map_frame", "map", "", "frame of the target"},
    {"scan_frame", "pcrb_scan", "", "frame of the source in localization"},
    {"publish_tf", "true", "", "frames of the server, published on tf"},
    {"cache_memory_mb", "2048", "MB", "memory for clouds that are kept"},
    {"load_threads", "1", "", "threads that read a cloud"},
};

namespace {

constexpr double kForever = 1e9;  // s

void readFolders(NodeParameters& reader, ServerParameters& parameters) {
  std::string& root = parameters.configuration.selection.root;
  root = reader.path("root");
  parameters.run = reader.path("run");
  parameters.configuration.under_test = reader.string("under_test");
  const bool is_absolute = std::filesystem::path(root).is_absolute();
  if (is_absolute && !std::filesystem::is_directory(root)) {
    reader.addMistake("~root: found `" + root + "`, expected an existing folder");
  }
}

void readSelection(NodeParameters& reader, ProblemSelection& selection) {
  selection.sequences = reader.words("sequences");
  if (selection.sequences.empty()) reader.addMistake("~sequences: names no sequence");
  std::sort(selection.sequences.begin(), selection.sequences.end());
  const std::string kind = reader.choice("kind");
  selection.kinds.clear();
  if (kind != "global") selection.kinds.push_back(Kind::kLocal);
  if (kind != "local") selection.kinds.push_back(Kind::kGlobal);
  selection.subset = static_cast<std::size_t>(reader.integer("subset", 0, 100000000));
  selection.seed = static_cast<std::uint64_t>(reader.integer("seed", 0, 2147483647));
  const std::string shard = reader.string("shard");
  try {
    selection.shard = shardFromString(shard);
  } catch (const InvalidParameter& error) {
    reader.addMistake(std::string("~") + error.what());
  }
}

void readPresentation(NodeParameters& reader, RunConfiguration& configuration) {
  configuration.presentation.kind = presentationFromString(reader.choice("presentation"));
  configuration.presentation.yaw_only = reader.boolean("yaw_only");
  configuration.presentation.audit = reader.boolean("audit");
  configuration.results =
      reader.choice("results") == "live" ? ResultsTime::kLive : ResultsTime::kEnd;
  configuration.global_guess = reader.boolean("global_guess");
  configuration.time_limit = reader.number("time_limit", 1e-3, kForever);
  configuration.handshake =
      reader.choice("handshake") == "ready" ? Handshake::kReady : Handshake::kNone;
  configuration.debug = reader.boolean("debug");
}

void readProtocol(NodeParameters& reader, ServerParameters& parameters) {
  parameters.connect_limit = reader.number("connect_limit", 0.1, kForever);
  parameters.ready_limit = reader.number("ready_limit", 0.1, kForever);
  parameters.summary_hold_time = reader.number("summary_hold_time", 0.0, 3600.0);
  parameters.allow_skipped = reader.boolean("allow_skipped");
  parameters.autostart = reader.boolean("autostart");
  parameters.publish_tf = reader.boolean("publish_tf");
}

void readFrames(NodeParameters& reader, ProblemFrames& frames) {
  frames.map = withoutSlash(reader.string("map_frame"));
  frames.scan = withoutSlash(reader.string("scan_frame"));
  if (frames.map.empty()) reader.addMistake("~map_frame: expected a name");
  if (frames.scan.empty()) reader.addMistake("~scan_frame: expected a name");
  if (frames.map == frames.scan) {
    reader.addMistake("~map_frame and ~scan_frame: expected two different names, found `" +
                      frames.map + "` for both");
  }
}

}  // namespace

ServerParameters readServerParameters() {
  NodeParameters reader(kServerParameters);
  ServerParameters parameters;
  readFolders(reader, parameters);
  readSelection(reader, parameters.configuration.selection);
  readPresentation(reader, parameters.configuration);
  readProtocol(reader, parameters);
  readFrames(reader, parameters.frames);
  parameters.loading.cache_bytes =
      static_cast<std::size_t>(reader.integer("cache_memory_mb", 1, 1 << 20)) << 20;
  parameters.loading.threads = reader.integer("load_threads", 1, 256);
  reader.finish();
  return parameters;
}

}  // namespace pcrb
