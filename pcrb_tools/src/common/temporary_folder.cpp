#include "common/temporary_folder.hpp"

#include <stdlib.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include "pcrb_core/error.hpp"

namespace pcrb_tools {

namespace fs = std::filesystem;

namespace {

fs::path folderForTemporaryFiles() {
  std::error_code error;
  const fs::path folder = fs::temp_directory_path(error);
  if (!error) return folder;
  const char* const variable = std::getenv("TMPDIR");
  throw pcrb::InvalidParameter("TMPDIR: found `" +
                               std::string(variable == nullptr ? "" : variable) +
                               "`, expected a folder that exists");
}

}  // namespace

TemporaryFolder::TemporaryFolder(const std::string& name)
    : path_((folderForTemporaryFiles() / (name + "_XXXXXX")).string()) {
  if (mkdtemp(path_.data()) == nullptr) {
    throw pcrb::InvalidFile(path_, std::string("cannot be made: ") + std::strerror(errno));
  }
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

}  // namespace pcrb_tools
