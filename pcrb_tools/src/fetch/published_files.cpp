#include "fetch/published_files.hpp"

#include <cstdint>
#include <filesystem>
#include <set>
#include <string_view>

#include "archives/archive_reader.hpp"
#include "archives/bag_messages.hpp"
#include "archives/bag_structure.hpp"
#include "pcrb_core/error.hpp"
#include "pcrb_core/io/atomic_file.hpp"
#include "pcrb_core/io/derived_file.hpp"
#include "pcrb_core/io/file_bytes.hpp"
#include "pcrb_core/io/foreign_data.hpp"
#include "pcrb_core/io/pcd.hpp"
#include "pcrb_core/problem/problem.hpp"

namespace pcrb_tools {
namespace {

namespace fs = std::filesystem;

/// Reads all of an archive: it must be whole, its files undamaged as far as it has checksums of
/// them, and its names must not point out of it.
void requireArchive(const std::string& path) {
  ArchiveReader archive(path);
  if (!archive.next()) throw pcrb::InvalidFile(path, 0, "an empty archive", "files in it");
  do {
    archive.verify();
  } while (archive.next());
}

void requireLog(const Source& source, const std::string& path) {
  pcrb::requireDataFile(path);
  if (!isBag(source.file)) return;
  requireWholeBag(path);
}

/// Three million points as text; the published clouds have at most a tenth of that.
constexpr std::uint64_t kMaxCloudBytes = std::uint64_t{1} << 27;

/// Number of clouds in a folder if they are all of an archive's, as they were unpacked: the note of
/// the last one says how many they are. Else 0.
std::size_t countUnpacked(const pcrb::DerivedFolder& folder, const std::string& sha256) {
  std::size_t count = 0;
  std::string all;
  for (const std::string& name : folder.ownFiles()) {
    const auto note = folder.kept(name, sha256);
    if (!note) continue;
    ++count;
    if (!note->empty()) all = *note;
  }
  return all == std::to_string(count) ? count : 0;
}

bool isCloud(const fs::path& path) {
  return path.extension() == ".pcd" && path.filename().string().front() != '.';
}

}  // namespace

void requireContent(const Source& source, const std::string& path,
                    const std::optional<std::uint64_t>& bytes) {
  if (bytes && fs::file_size(path) != *bytes) {
    throw pcrb::InvalidFile(path, 0, std::to_string(fs::file_size(path)) + " bytes",
                            std::to_string(*bytes));
  }
  switch (source.kind) {
    case SourceKind::kCloud:
      pcrb::readPcd(path);
      return;
    case SourceKind::kProblems:
      pcrb::readProblemFile(path);
      return;
    case SourceKind::kClouds:
      return requireArchive(path);
    case SourceKind::kLog:
      return isArchiveName(source.file) ? requireArchive(path) : requireLog(source, path);
  }
}

void putPublishedFile(const std::string& path, std::string_view bytes, const std::string& origin,
                      bool may_replace) {
  namespace fs = std::filesystem;
  if (fs::exists(path)) {
    if (pcrb::FileBytes(path).text() == bytes) return;
    if (!may_replace) {
      throw pcrb::InvalidFile(path, "is there and is not what was published (" + origin +
                                        "); move it away, or replace it with --force");
    }
  }
  fs::create_directories(fs::path(path).parent_path());
  pcrb::writeFileAtomically(path, bytes);
}

std::size_t unpackClouds(const std::string& archive, const std::string& sha256,
                         const std::string& folder, bool force,
                         const std::function<void()>& on_cloud) {
  pcrb::DerivedFolder unpacked(folder, archive + ".unpacked");
  if (const std::size_t count = countUnpacked(unpacked, sha256)) return count;
  ArchiveReader reader(archive);
  std::set<std::string> names;
  std::string last;
  while (reader.next()) {
    const fs::path entry = reader.name();
    if (!isCloud(entry)) continue;
    const std::string name = entry.filename().string();
    if (!names.insert(name).second) {
      throw pcrb::InvalidFile(archive, 0, "two entries '" + name + "'", "every cloud once");
    }
    const std::string bytes = reader.read(kMaxCloudBytes);
    const std::string origin = archive + "/" + reader.name();
    pcrb::parsePcd(bytes.data(), bytes.data() + bytes.size(), origin);
    putPublishedFile(unpacked.fileOf(name), bytes, origin, force || unpacked.isOwn(name));
    unpacked.record(name, sha256);
    last = name;
    if (on_cloud) on_cloud();
  }
  if (names.empty()) throw pcrb::InvalidFile(archive, 0, "no .pcd file", "an archive of clouds");
  unpacked.record(last, sha256, std::to_string(names.size()));
  return names.size();
}

}  // namespace pcrb_tools
