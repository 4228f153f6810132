#include "pcrb_server/sequence_path.hpp"

#include <filesystem>
#include <set>

#include "pcrb_core/error.hpp"

namespace pcrb {

std::string findSequenceFolder(const std::string& root, const std::string& word) {
  namespace fs = std::filesystem;
  if (!fs::is_directory(root)) {
    throw InvalidParameter("root: found `" + root + "`, expected an existing folder");
  }
  std::set<std::string> found;
  if (word.find('/') != std::string::npos) {
    if (fs::is_directory(root + "/" + word)) found.insert(root + "/" + word);
  } else {
    for (const auto& data_set : fs::directory_iterator(root)) {
      const fs::path folder = data_set.path() / word;
      if (fs::is_directory(folder)) found.insert(folder.string());
    }
  }
  if (found.size() == 1) return *found.begin();
  std::string list;
  for (const auto& folder : found) list += " " + folder;
  throw InvalidParameter("sequence: found `" + word +
                         "`, expected the folder of one sequence below " + root +
                         (list.empty() ? ": there is none of that name" : ":" + list));
}

}  // namespace pcrb
