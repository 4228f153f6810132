#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "conversion/conversion.hpp"
#include "conversion/log_files.hpp"

namespace pcrb_tools {

/// A cloud that is made from one file of a log.
struct FileScan {
  std::size_t file = 0;  ///< index among the log's files
  std::string cloud_name;
  std::string origin;  ///< what the cloud depends on beside the file: pose, options
  /// Makes the cloud from the file's bytes; `path` is for messages.
  std::function<ConvertedScan(std::string_view bytes, const std::string& path)> make;
};

/// Converts scans that are one file each, in parallel: files of folders are read by the workers,
/// archives once from start to end.
void convertFileScans(const LogFiles& files, std::vector<FileScan> scans, Conversion& conversion);

}  // namespace pcrb_tools
