#pragma once

#include <cstdint>
#include <memory>
#include <string>

struct archive;

namespace pcrb_tools {

/// Whether a file name ends like an archive that ArchiveReader reads: zip, tar, tgz, tar.gz,
/// tar.bz2, tar.xz.
bool isArchiveName(const std::string& path);

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

  /// What a file of this archive may expand to at most, bytes: a hundred times the archive's size,
  /// and a little for small ones. Scans compress to a tenth; a few kilobytes can claim to be
  /// terabytes.
  std::uint64_t sizeLimit() const { return size_limit_; }

  /// The bytes of the file that next() went to.
  ///
  /// @throws InvalidFile  if they are damaged, encrypted or more than `max_size` or sizeLimit().
  std::string read(std::uint64_t max_size);

  /// Reads the file that next() went to without keeping it.
  /// @throws InvalidFile  as read() does.
  void verify();

 private:
  /// Reads the next bytes; returns how many, 0 at the end.
  std::size_t readSome(char* bytes, std::size_t size);
  [[noreturn]] void refuseLargerThan(std::uint64_t limit) const;
  [[noreturn]] void fail() const;

  std::string path_;
  std::string name_;
  std::uint64_t size_limit_ = 0;
  std::uint64_t claimed_size_ = 0;  ///< of the file that next() went to; 0 = unknown
  std::unique_ptr<archive, int (*)(archive*)> archive_;
};

}  // namespace pcrb_tools
