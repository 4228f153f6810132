#pragma once

#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace pcrb {

// "Made by this tool, from these inputs, with these parameters": by this a rerun keeps what is
// complete and unchanged, makes anew what is its own and outdated, and refuses to replace what is
// somebody else's.

/// Size and time of the last writing of a file, as `BYTES SECONDS.NANOSECONDS`: another text if it
/// was written, or replaced by an older one of the same size, as `cp -p` or `tar -x` leaves it.
/// @return  empty where there is no such file.
std::string fileIdentity(const std::string& path);

/// A file that a tool makes, and what it is made from: tool, parameters (seeds included) and input
/// files. This is kept as YAML in the side file `<path>.yaml`.
///
/// Inputs count as unchanged if their names and identities are the same.
class DerivedFile {
 public:
  DerivedFile(std::string path, std::string tool)
      : path_(std::move(path)), tool_(std::move(tool)) {}

  void setParameter(const std::string& name, const std::string& value);

  /// @throws InvalidFile  if the file does not exist.
  void addInput(const std::string& path);

  const std::string& path() const { return path_; }

  std::string text() const;  ///< what the side file says of tool, parameters and inputs

  /// Whether the file is there, complete, as it was written, and made from exactly this.
  bool isUpToDate() const;

  /// Whether the file is there, and begin() was the last to be called for it, with exactly this:
  /// for one that grows, and is always whole as far as it goes.
  bool isBegun() const;

  /// @throws InvalidFile  if the file is there but is not what its side file says: then somebody
  ///                      else made or changed it and a tool must not replace it.
  void requireReplaceable() const;

  /// To be called before the file is written: until record(), it counts as unfinished, so that a
  /// run after a kill makes it again instead of taking it for somebody else's. Clears temporary
  /// files that a killed run has left.
  void begin() const;

  /// Writes the side file of a file that has just been written.
  void record() const;

 private:
  std::string path_;
  std::string tool_;
  std::vector<std::pair<std::string, std::string>> parameters_;
  std::vector<std::pair<std::string, std::string>> inputs_;  ///< name, identity
};

/// Path of a derived file's side file.
std::string sideFile(const std::string& path);

/// Whether a file is there that no tool made, e.g. a published one: without side file.
bool isForeign(const std::string& path);

/// Name of the tool that made a file, as its side file says.
///
/// @param hash  fileHash() of the file.
/// @return      empty where there is no side file, or where it is not of a file with this hash:
///              then the file is somebody else's, such as a published one.
/// @throws InvalidFile  if the side file is there and cannot be read.
std::string generatorOf(const std::string& path, const std::string& hash);

/// A folder whose files a tool makes one by one, and what each was made from.
///
/// The record is a text file of a row per file, `name fingerprint identity note`, separated by
/// tabs; the last row of a name counts, and a name alone is of a file that was about to be written.
/// One process at a time; the functions can be called from several threads.
class DerivedFolder {
 public:
  /// Makes the folder, takes the record's lock, clears temporary files that a killed run has left.
  ///
  /// @param record  path of the record, in the folder or elsewhere.
  /// @throws InvalidFile  if it cannot be written, or another process is writing the folder.
  DerivedFolder(std::string path, const std::string& record);
  ~DerivedFolder();
  DerivedFolder(const DerivedFolder&) = delete;
  DerivedFolder& operator=(const DerivedFolder&) = delete;

  const std::string& path() const { return path_; }
  std::string fileOf(const std::string& name) const;

  /// The note of a file that is as it was written, from what has this fingerprint; else nothing.
  std::optional<std::string> kept(const std::string& name, const std::string& fingerprint) const;

  /// Whether the file is as it was written, from whatever.
  bool isOwn(const std::string& name) const;

  /// @throws InvalidFile  if a file of this name is there that is somebody else's: not recorded, or
  ///                      changed since.
  void requireReplaceable(const std::string& name) const;

  /// To be called before a file is written: after a kill, it is known to be the tool's own.
  void begin(const std::string& name);

  /// Records a file that has just been written.
  /// @param note  for the next run; without line ends.
  void record(const std::string& name, const std::string& fingerprint,
              const std::string& note = {});

  /// Names of those files, ascending.
  std::vector<std::string> ownFiles() const;

 private:
  struct Row {
    std::string fingerprint;
    std::string identity;  ///< empty: the file was about to be written
    std::string note;
  };

  void openRecord();
  void readRecord();
  void append(const std::string& text);
  std::optional<Row> find(const std::string& name) const;

  std::string path_;
  std::string record_;
  std::map<std::string, Row> rows_;
  mutable std::mutex mutex_;
  int descriptor_ = -1;
};

/// Whether a folder that is claimed may have other files in it.
enum class OtherFiles { kAllowed, kRefused };

/// Claims a folder for one purpose by a note in it: a new folder, or one whose note says the same.
///
/// @param note   name of the note's file.
/// @param lines  what the folder is for: tool and settings, one a line.
/// @throws InvalidFile  if the note says something else, naming every difference; if there is no
///                      note and other files are there that are refused; if the path is no folder.
void claimFolder(const std::string& folder, const std::string& note,
                 const std::vector<std::string>& lines, OtherFiles others);

}  // namespace pcrb
