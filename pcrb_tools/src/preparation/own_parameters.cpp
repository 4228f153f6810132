#include "preparation/own_parameters.hpp"

#include <yaml-cpp/yaml.h>

#include <filesystem>

#include "pcrb_core/error.hpp"
#include "pcrb_core/io/atomic_file.hpp"
#include "pcrb_core/io/number.hpp"
#include "pcrb_core/problem/dataset.hpp"

namespace pcrb_tools {
namespace {

void requireKnown(const std::optional<double>& wanted, double known, const std::string& option,
                  const std::string& path) {
  if (!wanted || *wanted == known) return;
  throw pcrb::InvalidParameter(option + ": found " + pcrb::formatShortest(*wanted) + ", expected " +
                               pcrb::formatShortest(known) + " as the data set has it (" + path +
                               " says otherwise)");
}

std::string formatRange(const pcrb::Range& range) {
  return "[" + pcrb::formatShortest(range.min) + ", " + pcrb::formatShortest(range.max) + "]";
}

std::string formatBounds(const pcrb::PerturbationBounds& bounds) {
  return "{translation: " + formatRange(bounds.translation) +
         ", rotation_deg: " + formatRange(bounds.rotation_deg) + "}";
}

/// The file's text, as a person would write it.
std::string formatParameters(const pcrb::Dataset& dataset) {
  std::string text = "overlap_distance: " + pcrb::formatShortest(dataset.overlap_distance) +
                     "  # m, between a point and one that it overlaps with\n" +
                     "voxel_leaf: " + pcrb::formatShortest(dataset.voxel_leaf) +
                     "  # m, of the voxel grids of methods and maps\n# bounds of the "
                     "perturbations, m and degrees\nlocal: " +
                     formatBounds(dataset.local) + "\nglobal: " + formatBounds(dataset.global) +
                     "\n";
  if (!dataset.sensor.empty()) {
    text += "sensor: " + YAML::Dump(YAML::Node(dataset.sensor)) + "\n";
  }
  return text;
}

}  // namespace

void settleParameters(const OwnRequest& request, const DatasetParameters& parameters,
                      std::ostream& out) {
  const std::string path =
      (std::filesystem::path(request.root) / request.data_set / "dataset.yaml").string();
  pcrb::Dataset dataset = pcrb::loadDataset(request.root, request.data_set);
  if (std::filesystem::exists(path) || pcrb::isPublished(request.data_set)) {
    requireKnown(parameters.overlap_distance, dataset.overlap_distance, "--overlap-distance", path);
    requireKnown(parameters.voxel_leaf, dataset.voxel_leaf, "--voxel-leaf", path);
    return;
  }
  if (parameters.overlap_distance) dataset.overlap_distance = *parameters.overlap_distance;
  if (parameters.voxel_leaf) dataset.voxel_leaf = *parameters.voxel_leaf;
  dataset.sensor = parameters.sensor;
  pcrb::writeFileAtomically(path, formatParameters(dataset));
  out << "wrote " << path << std::endl;
}

}  // namespace pcrb_tools
