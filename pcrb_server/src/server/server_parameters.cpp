#include "server/server_parameters.hpp"

#include <algorithm>
#include <filesystem>

#include "pcrb_core/error.hpp"
#include "pcrb_core/io/number.hpp"
#include "pcrb_server/message_conversion.hpp"
#include "pcrb_server/node_parameters.hpp"

namespace pcrb {

namespace {

constexpr double kForever = 1e9;  // s
constexpr int kMaxShards = 1000000;

std::string join(const std::vector<std::string>& words) {
  std::string text;
  for (const auto& word : words) text += (text.empty() ? "" : " ") + word;
  return text;
}

std::string kindsOf(const ServerParameters& parameters) {
  std::string kinds;
  for (const Kind kind : parameters.kinds)
    kinds += (kinds.empty() ? "" : " ") + std::string(toString(kind));
  return kinds;
}

std::string shardOf(const ServerParameters& parameters) {
  return std::to_string(parameters.shard) + "/" + std::to_string(parameters.shards);
}

/// `i/N`, counted from 0.
void parseShard(const std::string& text, ServerParameters& parameters) {
  const std::size_t slash = text.find('/');
  const auto shard = parseInt(text.substr(0, slash));
  const auto shards = slash == std::string::npos ? std::nullopt : parseInt(text.substr(slash + 1));
  if (!shard || !shards || *shard < 0 || *shard >= *shards || *shards > kMaxShards) {
    throw InvalidParameter("~shard: found `" + text + "`, expected i/N with 0 <= i < N");
  }
  parameters.shard = static_cast<int>(*shard);
  parameters.shards = static_cast<int>(*shards);
}

void readFolders(NodeParameters& reader, ServerParameters& parameters) {
  parameters.root = reader.requiredPath("root");
  parameters.run = reader.requiredPath("run");
  parameters.under_test = reader.string("under_test", "");
  const bool is_absolute = std::filesystem::path(parameters.root).is_absolute();
  if (is_absolute && !std::filesystem::is_directory(parameters.root)) {
    reader.addMistake("~root: found `" + parameters.root + "`, expected an existing folder");
  }
}

void readSelection(NodeParameters& reader, ServerParameters& parameters) {
  parameters.sequences = reader.words("sequences", "all");
  if (parameters.sequences.empty()) reader.addMistake("~sequences: names no sequence");
  std::sort(parameters.sequences.begin(), parameters.sequences.end());
  const std::string kind = reader.choice("kind", "local", {"local", "global", "both"});
  if (kind != "global") parameters.kinds.push_back(Kind::kLocal);
  if (kind != "local") parameters.kinds.push_back(Kind::kGlobal);
  parameters.subset = reader.integer("subset", 0, 0, 100000000);
  parameters.seed = reader.integer("seed", 1, 0, 2147483647);
  const std::string shard = reader.string("shard", "0/1");
  reader.check([&] { parseShard(shard, parameters); });
}

void readProtocol(NodeParameters& reader, ServerParameters& parameters) {
  parameters.presentation = presentationFromString(
      reader.choice("presentation", "registration", {"registration", "localization"}));
  parameters.handshake = reader.choice("handshake", "ready", {"ready", "none"}) == "ready";
  parameters.time_limit = reader.number("time_limit", 10.0, 1e-3, kForever);
  parameters.connect_limit = reader.number("connect_limit", 60.0, 0.1, kForever);
  parameters.ready_limit = reader.number("ready_limit", 60.0, 0.1, kForever);
  parameters.linger = reader.number("linger", 5.0, 0.0, 3600.0);
  parameters.global_guess = reader.boolean("global_guess", false);
  parameters.upright = reader.boolean("upright", false);
  parameters.debug = reader.boolean("debug", false);
  parameters.autostart = reader.boolean("autostart", true);
  parameters.map_frame = withoutSlash(reader.string("map_frame", "map"));
  parameters.scan_frame = withoutSlash(reader.string("scan_frame", "pcrb_scan"));
  parameters.publish_tf = reader.boolean("publish_tf", true);
  if (parameters.map_frame.empty()) reader.addMistake("~map_frame: expected a name");
  if (parameters.scan_frame.empty()) reader.addMistake("~scan_frame: expected a name");
  if (parameters.map_frame == parameters.scan_frame) {
    reader.addMistake("~map_frame and ~scan_frame: expected two different names, found `" +
                      parameters.map_frame + "` for both");
  }
}

}  // namespace

ServerParameters readServerParameters() {
  NodeParameters reader;
  ServerParameters parameters;
  readFolders(reader, parameters);
  readSelection(reader, parameters);
  readProtocol(reader, parameters);
  parameters.cache_bytes =
      static_cast<std::size_t>(reader.integer("cache_memory_mb", 2048, 1, 1 << 20)) << 20;
  parameters.load_threads = reader.integer("load_threads", 1, 1, 256);
  reader.finish();
  return parameters;
}

std::string describe(const ServerParameters& parameters) {
  const std::string subset = parameters.subset > 0 ? std::to_string(parameters.subset) : "all";
  return "results: " + parameters.run + "\nproblems: " + parameters.root + ", sequences " +
         join(parameters.sequences) + ", kind " + kindsOf(parameters) + ", subset " + subset +
         ", shard " + shardOf(parameters);
}

std::map<std::string, std::string> configuration(const ServerParameters& parameters) {
  return {{"under_test", parameters.under_test},
          {"sequences", join(parameters.sequences)},
          {"kinds", kindsOf(parameters)},
          {"presentation", toString(parameters.presentation)},
          {"subset", std::to_string(parameters.subset)},
          {"shard", shardOf(parameters)},
          {"seed", std::to_string(parameters.seed)},
          {"time_limit", formatShortest(parameters.time_limit)},
          {"handshake", parameters.handshake ? "ready" : "none"},
          {"global_guess", parameters.global_guess ? "true" : "false"},
          {"upright", parameters.upright ? "true" : "false"},
          {"debug", parameters.debug ? "true" : "false"}};
}

}  // namespace pcrb
