#include "common/sequence_paths.hpp"

#include <algorithm>
#include <filesystem>

#include "pcrb_core/error.hpp"
#include "pcrb_core/io/pcd.hpp"

namespace pcrb_tools {

SequenceFolder openSequenceFolder(const std::string& path) {
  namespace fs = std::filesystem;
  fs::path folder = fs::absolute(path).lexically_normal();
  if (!folder.has_filename()) folder = folder.parent_path();
  SequenceFolder opened;
  opened.path = folder.string();
  opened.sequence = folder.filename().string();
  opened.data_set = folder.parent_path().filename().string();
  opened.root = folder.parent_path().parent_path().string();
  if (opened.sequence.empty() || opened.data_set.empty()) {
    throw pcrb::InvalidFile(path, 0, "'" + opened.path + "'",
                            "a folder <root>/<data set>/<sequence>");
  }
  opened.clouds = pcrb::findClouds(opened.path);
  if (opened.clouds.empty())
    throw pcrb::InvalidFile(path, 0, "no .pcd file", "a sequence's clouds");
  return opened;
}

std::size_t positionOf(const SequenceFolder& folder, const std::string& name) {
  const auto found = std::find(folder.clouds.begin(), folder.clouds.end(), name);
  if (found == folder.clouds.end()) {
    throw pcrb::InvalidParameter("found no cloud '" + name + "' in " + folder.path +
                                 ", expected the name of one of its .pcd files");
  }
  return static_cast<std::size_t>(found - folder.clouds.begin());
}

void exclude(SequenceFolder& folder, const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    folder.clouds.erase(folder.clouds.begin() +
                        static_cast<std::ptrdiff_t>(positionOf(folder, name)));
  }
}

ProblemFilePath splitProblemFilePath(const std::string& path) {
  namespace fs = std::filesystem;
  const fs::path file = fs::absolute(path).lexically_normal();
  ProblemFilePath split;
  split.root = file.parent_path().parent_path().string();
  if (fs::is_regular_file(file)) {
    for (const auto& files : pcrb::findSequences(split.root)) {
      if (fs::path(files.problem_file).lexically_normal() != file) continue;
      split.files = files;
      return split;
    }
  }
  throw pcrb::InvalidFile(path, 0, "no problem file",
                          "<root>/<data set>/<sequence>_local.txt or _global.txt");
}

}  // namespace pcrb_tools
