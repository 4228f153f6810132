#pragma once

#include <string>

namespace pcrb_tools {

/// Size and time of writing of a file: changes when the file may have changed, but not with its
/// place. Empty if there is no such file.
std::string fileIdentity(const std::string& path);

}  // namespace pcrb_tools
