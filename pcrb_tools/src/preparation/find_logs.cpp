#include <algorithm>
#include <filesystem>
#include <functional>
#include <map>
#include <utility>

#include "archives/archive_reader.hpp"
#include "archives/bag_messages.hpp"
#include "pcrb_core/datasets/eth.hpp"
#include "pcrb_core/datasets/kaist.hpp"
#include "pcrb_core/datasets/tum.hpp"
#include "pcrb_core/error.hpp"
#include "pcrb_core/io/pcd.hpp"
#include "pcrb_core/io/text.hpp"
#include "preparation/preparation.hpp"

namespace pcrb_tools {
namespace {

namespace fs = std::filesystem;
using Inputs = std::vector<std::string>;
using ByName = std::map<std::string, Inputs>;

/// File name without the ending of an archive or a bag.
std::string stemOf(const fs::path& path) {
  std::string name = path.filename().string();
  if (fs::is_directory(path)) return name;
  if (isArchiveName(name)) {
    const std::size_t tar = name.find(".tar");
    return tar != std::string::npos ? name.substr(0, tar) : name.substr(0, name.rfind('.'));
  }
  return path.stem().string();
}

/// Folders, archives and bags in a folder, in natural order; empty if there is no such folder.
std::vector<fs::path> candidates(const fs::path& folder) {
  std::vector<fs::path> paths;
  if (!fs::is_directory(folder)) return paths;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    const bool is_log = entry.is_directory() || isArchiveName(name) || isBag(entry.path().string());
    if (is_log && name[0] != '.') paths.push_back(entry.path());
  }
  std::sort(paths.begin(), paths.end(),
            [](const auto& a, const auto& b) { return pcrb::naturalLess(a.string(), b.string()); });
  return paths;
}

/// Groups by a name; what the name function knows nothing of is a sequence of its own.
ByName groupBy(const std::vector<fs::path>& paths,
               const std::function<std::string(const std::string&)>& name_of) {
  ByName groups;
  for (const auto& path : paths) {
    const std::string stem = stemOf(path);
    const std::string name = name_of(stem);
    groups[name.empty() ? stem : name].push_back(path.string());
  }
  return groups;
}

std::string planetarySet(const std::string& stem) {
  for (const char* set : {"box_met", "p2at_met"}) {
    if (pcrb::startsWith(stem, set)) return set;
  }
  return {};
}

/// The best recording of a TUM sequence: clouds, raw images, PNGs.
Inputs bestRecording(const Inputs& inputs) {
  const auto rank = [](const std::string& path) {
    if (!isBag(path)) return 2;
    return path.find("-with-pointclouds") != std::string::npos ? 0 : 1;
  };
  return {*std::min_element(inputs.begin(), inputs.end(),
                            [&rank](const auto& a, const auto& b) { return rank(a) < rank(b); })};
}

/// The log of a KAIST sequence; its bags only if there is nothing else.
Inputs withoutBags(const Inputs& inputs) {
  Inputs kept;
  for (const auto& input : inputs) {
    if (!isBag(input)) kept.push_back(input);
  }
  return kept.empty() ? inputs : kept;
}

}  // namespace

std::vector<SequenceLog> findLogs(const std::string& logs) {
  const auto in = [&logs](const char* data_set) { return candidates(fs::path(logs) / data_set); };
  std::vector<SequenceLog> sequences;
  const auto add = [&sequences](const char* data_set, const ByName& groups, auto choose) {
    for (const auto& [name, inputs] : groups) {
      sequences.push_back({data_set, name, choose(inputs)});
    }
  };
  const auto all = [](const Inputs& inputs) { return inputs; };
  add("eth", groupBy(in("eth"), pcrb::ethSequenceName), all);
  add("kaist", groupBy(in("kaist"), pcrb::kaistSequenceName), withoutBags);
  add("planetary", groupBy(in("planetary"), planetarySet), all);
  add("tum", groupBy(in("tum"), pcrb::tumSequenceName), bestRecording);
  if (sequences.empty()) {
    throw pcrb::InvalidFile(logs, 0, "no log", "folders eth, planetary, tum or kaist with logs");
  }
  return sequences;
}

}  // namespace pcrb_tools
