#include "fetch/content.hpp"

#include <filesystem>
#include <fstream>
#include <string_view>

#include "archives/archive_reader.hpp"
#include "pcrb_core/error.hpp"
#include "pcrb_core/io/pcd.hpp"
#include "pcrb_core/problem/problem.hpp"

namespace pcrb_tools {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kBagMagic = "#ROSBAG V2.0";

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
  if (beginsLikeHtml(path)) throw pcrb::InvalidFile(path, 0, "an HTML page", "a log");
  if (fs::path(source.file).extension() != ".bag") return;
  std::string magic(kBagMagic.size(), ' ');
  std::ifstream(path, std::ios::binary).read(magic.data(), static_cast<long>(magic.size()));
  if (magic != kBagMagic) throw pcrb::InvalidFile(path, 0, "another beginning", "a bag of ROS 1");
}

}  // namespace

void requireContent(const Source& source, const std::string& path) {
  if (source.bytes && fs::file_size(path) != *source.bytes) {
    throw pcrb::InvalidFile(path, 0, std::to_string(fs::file_size(path)) + " bytes",
                            std::to_string(*source.bytes));
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

}  // namespace pcrb_tools
