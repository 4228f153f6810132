#include <algorithm>
#include <filesystem>
#include <iostream>

#include "common/process.hpp"
#include "common/progress.hpp"
#include "common/sequence_paths.hpp"
#include "common/tool_main.hpp"
#include "pcrb_core/error.hpp"
#include "pcrb_core/io/number.hpp"
#include "pcrb_core/io/pcd.hpp"
#include "pcrb_core/parallel.hpp"
#include "pcrb_core/search/voxel_map.hpp"
#include "preparation/preparation_tools.hpp"

namespace pcrb_tools {
namespace {

pcrb::DerivedFile describeMap(const std::string& path, const SequenceFolder& folder, double leaf) {
  pcrb::DerivedFile map(path, "build_map");
  map.setParameter("leaf", pcrb::formatShortest(leaf));
  for (const std::string& name : folder.clouds) map.addInput(folder.cloud(name));
  return map;
}

/// Clouds are read a few at a time in parallel and added in the sequence's order.
pcrb::VoxelMap mergeClouds(const SequenceFolder& folder, double leaf, int threads) {
  pcrb::VoxelMap map(leaf);
  Progress progress(folder.sequence, "clouds", folder.clouds.size());
  const auto batch = static_cast<std::size_t>(threads);
  for (std::size_t first = 0; first < folder.clouds.size(); first += batch) {
    const std::size_t n = std::min(batch, folder.clouds.size() - first);
    std::vector<pcrb::DatasetCloud> clouds(n);
    pcrb::parallelFor(n, threads, [&](std::size_t i) {
      clouds[i] = pcrb::readPcd(folder.cloud(folder.clouds[first + i]));
    });
    for (const pcrb::DatasetCloud& cloud : clouds) map.add(cloud);
    progress.add(n);
    Interruption::check();
  }
  progress.finish();
  return map;
}

/// A map in the folder that it is made from would become part of itself.
void leaveOutOutput(SequenceFolder& folder, const std::string& output) {
  namespace fs = std::filesystem;
  const fs::path path = fs::absolute(output).lexically_normal();
  if (path.parent_path() != fs::path(folder.path)) return;
  const std::string name = path.filename().string();
  folder.clouds.erase(std::remove(folder.clouds.begin(), folder.clouds.end(), name),
                      folder.clouds.end());
}

}  // namespace

void runMapTool(const MapOptions& options) {
  SequenceFolder folder = openSequenceFolder(options.folder);
  exclude(folder, options.excluded);
  leaveOutOutput(folder, options.output);
  const double leaf =
      options.leaf ? *options.leaf : pcrb::loadDataset(folder.root, folder.data_set).voxel_leaf;
  const pcrb::DerivedFile output = describeMap(options.output, folder, leaf);
  if (isKept(output, options.force)) return;
  const pcrb::VoxelMap map = mergeClouds(folder, leaf, options.threads);
  if (map.size() == 0) throw pcrb::InvalidProblem(folder.path + ": the clouds have no points");
  output.begin();
  writePcd(options.output, map.cloud());
  output.record();
  std::cerr << options.output << ": " << map.size() << " points from " << folder.clouds.size()
            << " clouds" << std::endl;
}

}  // namespace pcrb_tools
