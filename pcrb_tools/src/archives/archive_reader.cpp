#include "archives/archive_reader.hpp"

#include <archive.h>
#include <archive_entry.h>
#include <locale.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <string_view>
#include <vector>

#include "pcrb_core/error.hpp"
#include "pcrb_core/io/foreign_data.hpp"
#include "pcrb_core/io/text.hpp"

namespace pcrb_tools {
namespace {

constexpr std::size_t kBlockSize = 1 << 18;
constexpr std::uint64_t kMaxExpansion = 100;
constexpr std::uint64_t kHarmlessSize = 1 << 20;  ///< bytes, whatever the archive's size

bool hasControlCharacter(const std::string& name) {
  return std::any_of(name.begin(), name.end(),
                     [](unsigned char c) { return c < 0x20 || c == 0x7f; });
}

/// While it lives, this thread's names of files are UTF-8: libarchive refuses an entry of a zip
/// whose name the user's locale cannot show.
class Utf8Names {
 public:
  Utf8Names() : former_(uselocale(utf8())) {}
  ~Utf8Names() { uselocale(former_); }
  Utf8Names(const Utf8Names&) = delete;
  Utf8Names& operator=(const Utf8Names&) = delete;

 private:
  /// Null, which changes nothing, where the system does not have it.
  static locale_t utf8() {
    static const locale_t locale = newlocale(LC_CTYPE_MASK, "C.UTF-8", nullptr);
    return locale;
  }

  locale_t former_;
};

void require(int status, archive* reader, const std::string& path) {
  if (status == ARCHIVE_OK) return;
  const char* const what = archive_error_string(reader);
  throw pcrb::InvalidFile(path, what == nullptr ? "cannot be read as an archive" : what);
}

}  // namespace

bool isArchiveName(const std::string& path) {
  constexpr std::array<std::string_view, 6> kEnds = {".zip",    ".tar",     ".tgz",
                                                     ".tar.gz", ".tar.bz2", ".tar.xz"};
  return std::any_of(kEnds.begin(), kEnds.end(),
                     [&path](std::string_view end) { return pcrb::endsWith(path, end); });
}

std::string requirePlainEntryName(const std::string& name, const std::string& archive_path) {
  const auto refuse = [&] {
    throw pcrb::InvalidFile(archive_path, 0, "the name " + pcrb::inQuotes(name),
                            "names of files below the archive's own folder");
  };
  if (name.empty() || name.front() == '/' || name.find('\\') != std::string::npos ||
      hasControlCharacter(name)) {
    refuse();
  }
  std::string plain;
  for (std::size_t begin = 0; begin < name.size();) {
    const std::size_t end = std::min(name.find('/', begin), name.size());
    const std::string part = name.substr(begin, end - begin);
    if (part == "..") refuse();
    if (!part.empty() && part != ".") plain += (plain.empty() ? "" : "/") + part;
    begin = end + 1;
  }
  if (plain.empty()) refuse();
  return plain;
}

ArchiveReader::ArchiveReader(const std::string& path)
    : path_(path), archive_(archive_read_new(), &archive_read_free) {
  if (!archive_) throw std::bad_alloc();
  for (const auto support : {archive_read_support_format_zip, archive_read_support_format_tar,
                             archive_read_support_filter_gzip, archive_read_support_filter_bzip2,
                             archive_read_support_filter_xz}) {
    require(support(archive_.get()), archive_.get(), path_);
  }
  if (archive_read_open_filename(archive_.get(), path_.c_str(), kBlockSize) != ARCHIVE_OK) fail();
  size_limit_ = kHarmlessSize + kMaxExpansion * std::filesystem::file_size(path_);
}

ArchiveReader::~ArchiveReader() = default;

bool ArchiveReader::next() {
  const Utf8Names utf8_names;
  archive_entry* entry = nullptr;
  for (;;) {
    const int status = archive_read_next_header(archive_.get(), &entry);
    if (status == ARCHIVE_EOF) return false;
    // A warning means a name that the locale cannot show; it is taken as UTF-8 instead.
    if (status != ARCHIVE_OK && status != ARCHIVE_WARN) fail();
    const char* name = archive_entry_pathname_utf8(entry);
    if (name == nullptr) name = archive_entry_pathname(entry);
    if (name == nullptr) fail();
    if (archive_entry_filetype(entry) != AE_IFREG) continue;
    name_ = requirePlainEntryName(name, path_);
    claimed_size_ = archive_entry_size_is_set(entry) != 0
                        ? static_cast<std::uint64_t>(archive_entry_size(entry))
                        : 0;
    return true;
  }
}

std::size_t ArchiveReader::readSome(char* bytes, std::size_t size) {
  const auto got = archive_read_data(archive_.get(), bytes, size);
  if (got < 0) fail();
  return static_cast<std::size_t>(got);
}

std::string ArchiveReader::read(std::uint64_t max_size) {
  const std::uint64_t limit = std::min(max_size, size_limit_);
  if (claimed_size_ > limit) refuseLargerThan(limit);
  std::string bytes;
  for (std::uint64_t used = 0;;) {
    // One byte more than claimed or allowed, to see whether the file goes on.
    const std::uint64_t wanted = used <= claimed_size_
                                     ? claimed_size_ + 1
                                     : used + std::max<std::uint64_t>(kBlockSize, used / 2);
    bytes.resize(std::min(limit + 1, wanted));
    const std::size_t got = readSome(bytes.data() + used, bytes.size() - used);
    used += got;
    if (used > limit) refuseLargerThan(limit);
    if (got > 0) continue;
    bytes.resize(used);
    return bytes;
  }
}

void ArchiveReader::verify() {
  std::vector<char> block(kBlockSize);
  std::uint64_t used = 0;
  while (const std::size_t got = readSome(block.data(), block.size())) {
    used += got;
    if (used > size_limit_) refuseLargerThan(size_limit_);
  }
}

void ArchiveReader::refuseLargerThan(std::uint64_t limit) const {
  throw pcrb::InvalidFile(
      path_, 0,
      "an entry " + pcrb::inQuotes(name_) + " of more than " + std::to_string(limit) + " bytes",
      limit < size_limit_
          ? "at most that much in a file of its kind"
          : "at most " + std::to_string(kMaxExpansion) + " times the size of the archive");
}

void ArchiveReader::fail() const {
  pcrb::requireDataFile(path_);
  const char* const what = archive_error_string(archive_.get());
  const std::string where = name_.empty() ? "" : ", at or after the entry " + pcrb::inQuotes(name_);
  throw pcrb::InvalidFile(
      path_,
      "damaged or no archive: " + std::string(what == nullptr ? "unknown format" : what) + where);
}

}  // namespace pcrb_tools
