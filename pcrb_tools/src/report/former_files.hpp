#pragma once

#include <string>

namespace pcrb_tools {

/// Removes the tables and figures of the report that a folder holds, so that none of them lies
/// beside the next report's. Its report.json says which they are; other files stay.
void removeFormerFiles(const std::string& folder);

}  // namespace pcrb_tools
