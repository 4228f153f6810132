#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace pcrb_tools {

/// What a file to fetch is.
enum class SourceKind {
  kLog,      ///< original archive or bag: converted
  kClouds,   ///< published archive of .pcd files: unpacked into the sequence's folder
  kCloud,    ///< one published .pcd file
  kProblems  ///< published problem file
};

/// One file of the list of sources.
struct Source {
  std::string data_set;
  std::string sequence;
  bool is_published = false;  ///< belongs to the published problem files
  bool is_original = false;   ///< belongs to the original logs
  SourceKind kind = SourceKind::kLog;
  std::string file;     ///< name below the folder of logs, with folders
  std::string url;      ///< empty: must be had by hand
  std::string by_hand;  ///< how
  std::string needs;    ///< `<data set>/<sequence>` whose clouds the problems pose; empty = its own
  bool google_drive = false;
  std::optional<std::uint64_t> bytes;
  std::string sha256;  ///< empty: recorded at the first download

  /// `<data set>/<sequence>`.
  std::string name() const { return data_set + "/" + sequence; }
};

/// Reads the list of sources (config/datasets.yaml explains its keys).
///
/// Names must stay below their folders: no `..`, no absolute paths.
/// @throws pcrb::InvalidFile  with file and line for unknown keys, wrong types, impossible values,
///                            needs that the list has not, and files that are named twice.
std::vector<Source> readSources(const std::string& path);

}  // namespace pcrb_tools
