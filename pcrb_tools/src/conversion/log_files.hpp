#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "pcrb_core/error.hpp"
#include "pcrb_core/io/file_bytes.hpp"

namespace pcrb_tools {

/// A file of an original log, in a folder or in an archive.
struct LogFile {
  std::string container;  ///< path of the folder, the archive, or the file itself
  std::string name;       ///< path inside, separated by `/`; the file name if it is itself given
  bool in_archive = false;
  std::string identity;  ///< changes when the file may have changed: size and time of writing

  std::string path() const;      ///< for messages: `logs.zip/csv_global/PointCloud0.csv`
  std::string fileName() const;  ///< last part of the name
  std::string folder() const;    ///< the name without its last part, empty or with `/` at its end
};

/// The files of an original log, given as folders, archives and single files.
///
/// Hidden files are passed over. Archives below a folder count as folders.
class LogFiles {
 public:
  using Predicate = std::function<bool(const LogFile&)>;
  using Taker = std::function<void(std::size_t index, std::string bytes)>;

  /// Lists all files, sorted within each input, and reads the small ones that are wanted at once
  /// (poses, stamps, calibration), because to find a file in an archive means to read it all.
  ///
  /// @throws InvalidFile  if an input does not exist, is damaged, or holds no file.
  LogFiles(const std::vector<std::string>& inputs, const Predicate& read_at_once);

  const std::vector<LogFile>& all() const { return files_; }

  /// Indices of the files that a predicate wants.
  std::vector<std::size_t> find(const Predicate& wanted) const;

  /// Index of the one file of a name.
  /// @throws InvalidFile  if there is none, or several.
  std::size_t findOne(const std::string& file_name) const;

  /// Bytes of a file that was read at once.
  const std::string& text(std::size_t index) const { return texts_.at(index); }

  /// Reads a file that is in no archive; can be called from several threads.
  pcrb::FileBytes read(std::size_t index) const;

  /// Reads those of the files that are in archives, in the archives' order.
  void readArchived(const std::vector<std::size_t>& indices, const Taker& take) const;

 private:
  void addInput(const std::string& input);  // appends to files_ or archives_
  void addFolder(const std::string& container, const std::string& folder,
                 std::vector<std::string>& visited);
  void addArchive(const std::string& path, const Predicate& read_at_once);

  std::vector<LogFile> files_;
  std::vector<std::string> archives_;
  std::map<std::size_t, std::string> texts_;
};

/// Parses a file that is asked for, else the one of a name in the log, which was read at once.
///
/// @param path   that is asked for; empty: none.
/// @param log    may be null.
/// @param parse  takes the text and the path for messages.
template <typename Parse>
auto parseChosen(const std::string& path, const LogFiles* log, const std::string& file_name,
                 Parse parse) {
  if (!path.empty()) return parse(pcrb::FileBytes(path).text(), path);
  if (log == nullptr) throw pcrb::InvalidFile("input", 0, "0 files " + file_name, "one");
  const std::size_t index = log->findOne(file_name);
  return parse(log->text(index), log->all()[index].path());
}

/// A hidden folder for files from an archive that are needed in another order than they come in.
/// Names in it are numbers, never the archive's. It goes with the object; what a killed run left
/// goes with the next run.
class SpoolFolder {
 public:
  /// @param folder  of the clouds; nothing is made before the first write
  explicit SpoolFolder(const std::string& folder);
  ~SpoolFolder();
  SpoolFolder(const SpoolFolder&) = delete;
  SpoolFolder& operator=(const SpoolFolder&) = delete;

  /// @throws InvalidFile  if the disk is full or not writable.
  void write(std::size_t number, const std::string& bytes) const;

  std::string path(std::size_t number) const;

 private:
  std::string folder_;
};

}  // namespace pcrb_tools
