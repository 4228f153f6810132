#include "pcrb_core/problem/dataset.hpp"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include "pcrb_core/error.hpp"
#include "pcrb_core/io/file_bytes.hpp"
#include "pcrb_core/io/foreign_data.hpp"
#include "pcrb_core/io/number.hpp"
#include "pcrb_core/io/text.hpp"

namespace pcrb {
namespace {

/// Parameters of the published data sets (docs/methods.md), others' defaults.
Dataset builtIn(const std::string& name, BoundsSource source) {
  const bool is_note = source == BoundsSource::kNote;
  Dataset dataset;
  dataset.name = name;
  if (name == "eth") {
    dataset.overlap_distance = 0.1;
    dataset.local.translation = {0, 1};
    dataset.global.translation = is_note ? Range{1.5, 15} : Range{1.5, 10};
    dataset.sensor = "tilting 2D lidar";
    dataset.characteristics = {"lidar"};
  } else if (name == "planetary") {
    dataset.local.translation = is_note ? Range{0, 2} : Range{0, 3};
    dataset.sensor = "3D lidar on a rover";
    dataset.characteristics = {"outdoor", "unstructured", "lidar"};
  } else if (name == "tum") {
    dataset.overlap_distance = 0.01;
    dataset.voxel_leaf = 0.1;
    dataset.local.translation = {0, 1};
    dataset.global.translation = {1.5, 15};
    dataset.sensor = "RGB-D camera";
    dataset.characteristics = {"indoor", "structured", "rgbd"};
  } else if (name == "kaist") {
    dataset.local.translation = is_note ? Range{0, 2} : Range{0, 1};
    dataset.global.translation = is_note ? Range{4, 15} : Range{1.5, 15};
    dataset.sensor = "two tilted 3D lidars on a car";
    dataset.characteristics = {"outdoor", "urban", "structured", "lidar"};
  }
  return dataset;
}

/// Reads the values of one dataset.yaml; every mistake names its line.
class DatasetYaml {
 public:
  explicit DatasetYaml(std::string path) : path_(std::move(path)) {}

  void readInto(Dataset& dataset) const {
    const FileBytes file(path_);
    requireData(file.text(), path_);
    try {
      readMap(YAML::Load(std::string(file.text())),
              {{"sensor", [&](const YAML::Node& value) { dataset.sensor = text(value); }},
               {"overlap_distance",
                [&](const YAML::Node& value) { dataset.overlap_distance = length(value); }},
               {"voxel_leaf", [&](const YAML::Node& value) { dataset.voxel_leaf = length(value); }},
               {"local", [&](const YAML::Node& value) { readBounds(value, dataset.local); }},
               {"global", [&](const YAML::Node& value) { readBounds(value, dataset.global); }},
               {"characteristics",
                [&](const YAML::Node& value) { dataset.characteristics = texts(value); }}});
    } catch (const YAML::Exception& error) {
      throw InvalidFile(path_, lineOf(error.mark), error.msg, "YAML");
    }
  }

 private:
  using Setters = std::map<std::string, std::function<void(const YAML::Node&)>>;

  static std::size_t lineOf(const YAML::Mark& mark) {
    return mark.is_null() ? 0 : static_cast<std::size_t>(mark.line) + 1;
  }

  static std::string describe(const YAML::Node& node) {
    if (node.IsScalar()) return inQuotes(node.Scalar());
    return node.IsMap() ? "a map" : node.IsSequence() ? "a list" : "nothing";
  }

  [[noreturn]] void fail(const YAML::Node& node, const std::string& found,
                         const std::string& expected) const {
    throw InvalidFile(path_, lineOf(node.Mark()), found, expected);
  }

  void readMap(const YAML::Node& map, const Setters& setters) const {
    std::string names;
    for (const auto& setter : setters) names += (names.empty() ? "" : ", ") + setter.first;
    if (!map.IsMap()) fail(map, describe(map), "a map with keys of " + names);
    std::set<std::string> seen;
    for (const auto& entry : map) {
      const std::string key = text(entry.first);
      const auto setter = setters.find(key);
      if (setter == setters.end()) {
        fail(entry.first, "unknown key " + inQuotes(key), "one of " + names);
      }
      if (!seen.insert(key).second) fail(entry.first, "key " + inQuotes(key) + " again", "it once");
      // A missing value's own mark is that of whatever comes next.
      if (entry.second.IsNull()) fail(entry.first, "nothing after " + inQuotes(key), "a value");
      setter->second(entry.second);
    }
  }

  void readBounds(const YAML::Node& node, PerturbationBounds& bounds) const {
    constexpr double kHalfTurn = 180.0;
    const double no_limit = std::numeric_limits<double>::infinity();
    readMap(node, {{"translation",
                    [&](const YAML::Node& value) { bounds.translation = range(value, no_limit); }},
                   {"rotation_deg", [&](const YAML::Node& value) {
                      bounds.rotation_deg = range(value, kHalfTurn);
                    }}});
  }

  Range range(const YAML::Node& node, double limit) const {
    const std::string expected =
        "[min, max] with 0 <= min <= max" +
        (std::isinf(limit) ? std::string() : " <= " + formatShortest(limit));
    if (!node.IsSequence() || node.size() != 2) fail(node, describe(node), expected);
    const Range range{number(node[0]), number(node[1])};
    if (!(range.min >= 0.0 && range.min <= range.max && range.max <= limit)) {
      fail(node, "[" + formatShortest(range.min) + ", " + formatShortest(range.max) + "]",
           expected);
    }
    return range;
  }

  double number(const YAML::Node& node) const {
    const auto value = node.IsScalar() ? parseDouble(node.Scalar()) : std::nullopt;
    if (!value || !std::isfinite(*value)) fail(node, describe(node), "a finite number");
    return *value;
  }

  double length(const YAML::Node& node) const {
    const double value = number(node);
    if (value <= 0.0) fail(node, describe(node), "a length above 0 m");
    return value;
  }

  std::string text(const YAML::Node& node) const {
    if (!node.IsScalar()) fail(node, describe(node), "a text");
    return node.Scalar();
  }

  std::vector<std::string> texts(const YAML::Node& node) const {
    if (!node.IsSequence()) fail(node, describe(node), "a list of texts");
    std::vector<std::string> values;
    for (const auto& entry : node) values.push_back(text(entry));
    return values;
  }

  std::string path_;
};

}  // namespace

bool isPublished(const std::string& data_set) {
  return !builtIn(data_set, BoundsSource::kMeasured).sensor.empty();
}

Dataset loadDataset(const std::string& root, const std::string& name, BoundsSource bounds) {
  Dataset dataset = builtIn(name, bounds);
  const std::filesystem::path path = std::filesystem::path(root) / name / "dataset.yaml";
  std::error_code ignored;  // what exists but cannot be read is reported by the read
  const auto status = std::filesystem::status(path, ignored);
  if (status.type() == std::filesystem::file_type::not_found) return dataset;
  DatasetYaml(path.string()).readInto(dataset);
  return dataset;
}

}  // namespace pcrb
