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

/// Which files of a sequence are wanted.
enum class SourceSet {
  kPublished,  ///< the clouds and problem files that were published
  kOriginal    ///< the original logs
};

/// Where a file can be downloaded, and what it must be then, where known.
struct Place {
  std::string url;            ///< of the file; with dspace_item that of the server's REST interface
  std::string dspace_item;    ///< UUID of an item in a DSpace 7 repository
  std::string dspace_name;    ///< of the file in that item
  bool google_drive = false;  ///< the download needs a confirmation
  std::optional<std::uint64_t> bytes;
  std::string sha256;  ///< empty: recorded at the first download
  std::string md5;     ///< as a repository says; never from the list

  /// For messages.
  std::string describe() const {
    return dspace_item.empty() ? url : dspace_name + " of item " + dspace_item + " at " + url;
  }
};

/// One file of the list of sources.
struct Source {
  std::string data_set;
  std::string sequence;
  bool is_published = false;  ///< belongs to the published problem files
  bool is_original = false;   ///< belongs to the original logs
  SourceKind kind = SourceKind::kLog;
  std::string file;           ///< name below the folder of logs, with folders
  std::vector<Place> places;  ///< tried in turn; empty: the file must be had by hand
  std::string by_hand;        ///< how
  std::string needs;  ///< `<data set>/<sequence>` whose clouds the problems pose; empty = its own

  /// What the file must be wherever it is from: something is known only where there is one place.
  Place known() const { return places.size() == 1 ? places.front() : Place(); }

  /// `<data set>/<sequence>`.
  std::string name() const { return data_set + "/" + sequence; }

  bool isOf(SourceSet set) const {
    return set == SourceSet::kOriginal ? is_original : is_published;
  }
};

/// Reads the list of sources (config/datasets.yaml explains its keys).
///
/// Names must stay below their folders: no `..`, no absolute paths.
/// @throws pcrb::InvalidFile  with file and line for unknown keys, wrong types, impossible values,
///                            needs that the list has not, and files that are named twice.
std::vector<Source> readSources(const std::string& path);

/// The files of a list to fetch for what is asked for, in the list's order: those of the wanted
/// sequences, and the logs and clouds of the sequences that these need.
///
/// @param list   path of the list.
/// @param words  as pcrb::namesSequence takes them; empty = all.
/// @throws pcrb::Error  if the list is malformed or a wanted sequence is not in it.
std::vector<Source> selectSources(const std::string& list, SourceSet set,
                                  const std::vector<std::string>& words);

}  // namespace pcrb_tools
