#include "pcrb_tools/fetch/unpack.hpp"

#include <cstdint>
#include <filesystem>
#include <map>
#include <string_view>

#include "pcrb_core/error.hpp"
#include "pcrb_core/io/atomic_file.hpp"
#include "pcrb_core/io/file_bytes.hpp"
#include "pcrb_tools/archive_reader.hpp"

namespace pcrb_tools {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kMaxCloudBytes = 4000000000;

/// Sizes of the unpacked clouds by name.
using Clouds = std::map<std::string, std::uintmax_t>;

std::string listFile(const std::string& archive) { return archive + ".unpacked"; }

std::string formatList(const std::string& sha256, const std::string& folder, const Clouds& clouds) {
  std::string text = "archive " + sha256 + "\nfolder " + folder + "\n";
  for (const auto& [name, bytes] : clouds) text += std::to_string(bytes) + " " + name + "\n";
  return text;
}

/// What the folder holds of the clouds that a list names.
std::size_t countKept(const std::string& archive, const std::string& sha256,
                      const std::string& folder) {
  if (!fs::is_regular_file(listFile(archive)) || !fs::is_directory(folder)) return 0;
  Clouds present;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.is_regular_file()) present[entry.path().filename().string()] = entry.file_size();
  }
  // Other files of the folder, such as a map, are not in the list: compare what it names.
  const pcrb::FileBytes bytes(listFile(archive));
  const std::string_view text = bytes.text();
  Clouds listed;
  for (const auto& [name, size] : present) {
    const std::string row = "\n" + std::to_string(size) + " " + name + "\n";
    if (text.find(row) != std::string_view::npos) listed[name] = size;
  }
  return formatList(sha256, folder, listed) == text ? listed.size() : 0;
}

bool isCloud(const fs::path& path) {
  return path.extension() == ".pcd" && path.filename().string().front() != '.';
}

}  // namespace

std::size_t unpackClouds(const std::string& archive, const std::string& sha256,
                         const std::string& folder, const std::function<void()>& on_cloud) {
  const std::size_t kept = countKept(archive, sha256, folder);
  if (kept > 0) return kept;
  fs::create_directories(folder);
  ArchiveReader reader(archive);
  Clouds clouds;
  while (reader.next()) {
    const fs::path entry = reader.name();
    if (!isCloud(entry)) continue;
    const std::string name = entry.filename().string();
    if (clouds.count(name) > 0) {
      throw pcrb::InvalidFile(archive, 0, "two entries '" + name + "'", "every cloud once");
    }
    const std::string bytes = reader.read(kMaxCloudBytes);
    pcrb::writeFileAtomically(folder + "/" + name, bytes);
    clouds[name] = bytes.size();
    if (on_cloud) on_cloud();
  }
  if (clouds.empty()) throw pcrb::InvalidFile(archive, 0, "no .pcd file", "an archive of clouds");
  pcrb::writeFileAtomically(listFile(archive), formatList(sha256, folder, clouds));
  return clouds.size();
}

}  // namespace pcrb_tools
