#include "common/temporary_folder.hpp"

#include <stdlib.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "pcrb_core/error.hpp"

namespace pcrb_tools {

namespace fs = std::filesystem;

TemporaryFolder::TemporaryFolder(const std::string& name)
    : path_((fs::temp_directory_path() / (name + "_XXXXXX")).string()) {
  if (mkdtemp(path_.data()) == nullptr) {
    throw pcrb::InvalidFile(path_, std::string("cannot be made: ") + std::strerror(errno));
  }
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

}  // namespace pcrb_tools
