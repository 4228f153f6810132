#include "fetch/put_file.hpp"

#include <filesystem>

#include "pcrb_core/error.hpp"
#include "pcrb_core/io/atomic_file.hpp"
#include "pcrb_core/io/file_bytes.hpp"

namespace pcrb_tools {

void putPublishedFile(const std::string& path, std::string_view bytes, const std::string& origin,
                      bool may_replace) {
  namespace fs = std::filesystem;
  if (fs::exists(path)) {
    if (pcrb::FileBytes(path).text() == bytes) return;
    if (!may_replace) {
      throw pcrb::InvalidFile(path, "is there and is not what was published (" + origin +
                                        "); move it away, or replace it with --force");
    }
  }
  fs::create_directories(fs::path(path).parent_path());
  pcrb::writeFileAtomically(path, bytes);
}

}  // namespace pcrb_tools
