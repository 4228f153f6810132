#pragma once

#include <string>

#include "fetch/sources.hpp"

namespace pcrb_tools {

/// Makes sure that a file is what its source says: of the right size where that is known, and whole
/// and readable as what it is. A page of HTML with a good name is not.
///
/// @throws pcrb::Error  naming the file, what was found and what was expected.
void requireContent(const Source& source, const std::string& path);

}  // namespace pcrb_tools
