#include "conversion/spool_folder.hpp"

#include <filesystem>
#include <fstream>
#include <system_error>

#include "pcrb_core/error.hpp"

namespace pcrb_tools {

namespace fs = std::filesystem;

SpoolFolder::SpoolFolder(const std::string& folder)
    : folder_((fs::path(folder) / ".spool").string()) {
  fs::remove_all(folder_);
}

SpoolFolder::~SpoolFolder() {
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
}

void SpoolFolder::write(std::size_t number, const std::string& bytes) const {
  fs::create_directories(folder_);
  std::ofstream file(path(number), std::ios::binary);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  file.close();
  if (!file) throw pcrb::InvalidFile(path(number), "cannot be written");
}

std::string SpoolFolder::path(std::size_t number) const {
  return (fs::path(folder_) / std::to_string(number)).string();
}

}  // namespace pcrb_tools
