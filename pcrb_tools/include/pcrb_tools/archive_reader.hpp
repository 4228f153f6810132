#pragma once

#include <cstdint>
#include <memory>
#include <string>

struct archive;

namespace pcrb_tools {

/// Whether a file name ends like an archive that ArchiveReader reads: zip, tar, tgz, tar.gz,
/// tar.bz2, tar.xz.
bool isArchiveName(const std::string& path);

/// Whether a file begins like a page of HTML: what comes instead of a file that needs a
/// confirmation.
bool beginsLikeHtml(const std::string& path);

/// A name from an archive or a list, made plain: no `.` parts, no doubled or trailing `/`.
///
/// Names are data of strangers: nothing outside the archive may be meant.
/// @throws InvalidFile  for absolute names, `..`, backslashes, control characters and empty names.
std::string requirePlainEntryName(const std::string& name, const std::string& archive_path);

/// Walks over the regular files of an archive, first to last. Nothing is ever extracted to disk.
class ArchiveReader {
 public:
  /// @throws InvalidFile  if the file is no archive; an HTML page in its place is named as such.
  explicit ArchiveReader(const std::string& path);
  ~ArchiveReader();
  ArchiveReader(const ArchiveReader&) = delete;
  ArchiveReader& operator=(const ArchiveReader&) = delete;

  /// Goes to the next regular file; false behind the last one. Folders and links are passed over.
  /// @throws InvalidFile  if the archive is damaged or an entry's name points out of it.
  bool next();

  const std::string& name() const { return name_; }

  /// The bytes of the file that next() went to.
  ///
  /// @throws InvalidFile  if they are damaged, encrypted or more than `max_size`: a few kilobytes
  ///                      can claim to be terabytes.
  std::string read(std::uint64_t max_size);

 private:
  [[noreturn]] void fail() const;

  std::string path_;
  std::string name_;
  std::unique_ptr<archive, int (*)(archive*)> archive_;
};

}  // namespace pcrb_tools
