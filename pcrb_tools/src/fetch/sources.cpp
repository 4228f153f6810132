#include "fetch/sources.hpp"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "archives/archive_reader.hpp"
#include "pcrb_core/error.hpp"
#include "pcrb_core/io/file_bytes.hpp"
#include "pcrb_core/io/number.hpp"
#include "pcrb_core/io/text.hpp"
#include "pcrb_core/problem/dataset.hpp"

namespace pcrb_tools {
namespace {

std::size_t lineOf(const YAML::Mark& mark) {
  return mark.is_null() ? 0 : static_cast<std::size_t>(mark.line) + 1;
}

/// Reads one list of sources; every mistake names its line.
class SourceReader {
 public:
  explicit SourceReader(std::string path) : path_(std::move(path)) {}

  std::vector<Source> read() {
    const pcrb::FileBytes file(path_);
    try {
      const YAML::Node list = YAML::Load(std::string(file.text()))["sources"];
      if (!list || !list.IsSequence()) fail(list, "no list", "`sources`, a list of files");
      std::vector<Source> sources;
      for (const YAML::Node& node : list) sources.push_back(readSource(node));
      for (std::size_t i = 0; i < sources.size(); ++i) requireNeeded(list[i], sources[i], sources);
      return sources;
    } catch (const YAML::Exception& error) {
      throw pcrb::InvalidFile(path_, lineOf(error.mark), error.msg, "YAML");
    }
  }

 private:
  [[noreturn]] void fail(const YAML::Node& node, const std::string& found,
                         const std::string& expected) const {
    throw pcrb::InvalidFile(path_, node ? lineOf(node.Mark()) : 0, found, expected);
  }

  std::string text(const YAML::Node& node) const {
    if (!node.IsScalar() || node.Scalar().empty()) fail(node, "no text", "a text");
    return node.Scalar();
  }

  /// A name that stays below its folder.
  std::string plainName(const YAML::Node& node) const {
    const std::string name = text(node);
    try {
      if (requirePlainEntryName(name, path_) == name) return name;
    } catch (const pcrb::InvalidFile&) {
      // said below, with the line
    }
    fail(node, pcrb::inQuotes(name), "a name below its folder");
  }

  template <typename T>
  T oneOf(const YAML::Node& node, const std::map<std::string, T>& values) const {
    const auto found = values.find(text(node));
    if (found != values.end()) return found->second;
    std::string expected;
    for (const auto& [name, value] : values) expected += (expected.empty() ? "" : ", ") + name;
    fail(node, pcrb::inQuotes(text(node)), expected);
  }

  std::string url(const YAML::Node& node) const {
    const std::string value = text(node);
    for (const char* scheme : {"http://", "https://", "ftp://"}) {
      if (pcrb::startsWith(value, scheme)) return value;
    }
    fail(node, pcrb::inQuotes(value), "an address of http, https or ftp");
  }

  std::string sha256(const YAML::Node& node) const {
    const std::string value = text(node);
    const bool is_hash =
        value.size() == 64 && value.find_first_not_of("0123456789abcdef") == std::string::npos;
    if (!is_hash) fail(node, pcrb::inQuotes(value), "64 hexadecimal digits");
    return value;
  }

  std::uint64_t bytes(const YAML::Node& node) const {
    const auto value = pcrb::parseUnsigned(text(node));
    if (!value) fail(node, pcrb::inQuotes(text(node)), "a number of bytes");
    return *value;
  }

  using Setters = std::map<std::string, std::function<void(const YAML::Node&)>>;

  void setAll(const YAML::Node& node, const Setters& setters) const {
    if (!node.IsMap()) fail(node, "no map", "the keys of a file");
    for (const auto& entry : node) {
      const auto setter = setters.find(text(entry.first));
      if (setter == setters.end())
        fail(entry.first, pcrb::inQuotes(text(entry.first)), "a known key");
      setter->second(entry.second);
    }
  }

  Setters placeSetters(Place& place) const {
    return {{"url", [&](const YAML::Node& value) { place.url = url(value); }},
            {"dspace_item", [&](const YAML::Node& value) { place.dspace_item = text(value); }},
            {"dspace_name", [&](const YAML::Node& value) { place.dspace_name = plainName(value); }},
            {"sha256", [&](const YAML::Node& value) { place.sha256 = sha256(value); }},
            {"bytes", [&](const YAML::Node& value) { place.bytes = bytes(value); }},
            {"google_drive", [&](const YAML::Node& value) {
               place.google_drive = oneOf<bool>(value, {{"true", true}, {"false", false}});
             }}};
  }

  void requireWhole(const YAML::Node& node, const Place& place) const {
    if (place.url.empty()) fail(node, "no url", "one");
    if (place.dspace_item.empty() != place.dspace_name.empty()) {
      fail(node, "one of dspace_item and dspace_name", "both or neither");
    }
  }

  std::vector<Place> readMirrors(const YAML::Node& node) const {
    if (!node.IsSequence()) fail(node, "no list", "a list of maps with a url");
    std::vector<Place> mirrors(node.size());
    for (std::size_t i = 0; i < node.size(); ++i) {
      setAll(node[i], placeSetters(mirrors[i]));
      requireWhole(node[i], mirrors[i]);
    }
    return mirrors;
  }

  Source readSource(const YAML::Node& node) {
    Source source;
    Place place;
    std::vector<Place> mirrors;
    Setters setters = placeSetters(place);
    setters.merge(
        Setters{{"data_set", [&](const YAML::Node& value) { source.data_set = plainName(value); }},
                {"sequence", [&](const YAML::Node& value) { source.sequence = plainName(value); }},
                {"file", [&](const YAML::Node& value) { source.file = plainName(value); }},
                {"mirrors", [&](const YAML::Node& value) { mirrors = readMirrors(value); }},
                {"by_hand", [&](const YAML::Node& value) { source.by_hand = text(value); }},
                {"needs", [&](const YAML::Node& value) { source.needs = text(value); }},
                {"kind",
                 [&](const YAML::Node& value) {
                   source.kind = oneOf<SourceKind>(value, {{"log", SourceKind::kLog},
                                                           {"clouds", SourceKind::kClouds},
                                                           {"cloud", SourceKind::kCloud},
                                                           {"problems", SourceKind::kProblems}});
                 }},
                {"set", [&](const YAML::Node& value) { readSet(value, source); }}});
    setAll(node, setters);
    if (!place.url.empty()) {
      requireWhole(node, place);
      source.places.push_back(place);
    }
    source.places.insert(source.places.end(), mirrors.begin(), mirrors.end());
    requireComplete(node, source);
    return source;
  }

  void readSet(const YAML::Node& node, Source& source) const {
    const int set = oneOf<int>(node, {{"published", 1}, {"original", 2}, {"both", 3}});
    source.is_published = (set & 1) != 0;
    source.is_original = (set & 2) != 0;
  }

  void requireComplete(const YAML::Node& node, const Source& source) {
    for (const char* key : {"data_set", "sequence", "set", "kind", "file"}) {
      if (!node[key])
        fail(node, std::string("no ") + key, "data_set, sequence, set, kind and file");
    }
    if (source.places.empty() == source.by_hand.empty()) {
      fail(node, source.places.empty() ? "neither" : "both", "either url or by_hand");
    }
    if (!files_.insert(source.file).second) fail(node, source.file + " again", "every file once");
  }

  void requireNeeded(const YAML::Node& node, const Source& source,
                     const std::vector<Source>& all) const {
    const auto is_needed = [&](const Source& other) { return other.name() == source.needs; };
    if (source.needs.empty() || std::any_of(all.begin(), all.end(), is_needed)) return;
    fail(node["needs"], pcrb::inQuotes(source.needs), "<data set>/<sequence> of this list");
  }

  std::string path_;
  std::set<std::string> files_;
};

}  // namespace

std::vector<Source> readSources(const std::string& path) { return SourceReader(path).read(); }

std::vector<Source> selectSources(const std::string& list, SourceSet set,
                                  const std::vector<std::string>& words) {
  std::vector<Source> all = readSources(list);
  all.erase(std::remove_if(all.begin(), all.end(), [set](const Source& s) { return !s.isOf(set); }),
            all.end());
  std::vector<pcrb::SequenceName> names;
  for (const Source& source : all) names.push_back({source.data_set, source.sequence});
  const auto wanted = pcrb::selectNamed(names, words, [&](const std::string& word) {
    throw pcrb::InvalidParameter(list + ": found no source of '" + word +
                                 "', expected a sequence, <data set> or <data set>/<sequence>");
  });
  std::set<std::string> needed;
  for (const std::size_t i : wanted) needed.insert(all[i].needs);
  std::vector<Source> selected;
  for (std::size_t i = 0; i != all.size(); ++i) {
    const bool is_needed = all[i].kind != SourceKind::kProblems && needed.count(all[i].name()) > 0;
    if (is_needed || std::binary_search(wanted.begin(), wanted.end(), i))
      selected.push_back(all[i]);
  }
  return selected;
}

}  // namespace pcrb_tools
