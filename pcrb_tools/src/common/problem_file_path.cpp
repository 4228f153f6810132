#include "common/problem_file_path.hpp"

#include <filesystem>

#include "pcrb_core/error.hpp"

namespace pcrb_tools {

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
