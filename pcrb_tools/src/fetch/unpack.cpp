#include "fetch/unpack.hpp"

#include <cstdint>
#include <filesystem>
#include <map>
#include <string_view>

#include "archives/archive_reader.hpp"
#include "common/file_identity.hpp"
#include "fetch/put_file.hpp"
#include "pcrb_core/error.hpp"
#include "pcrb_core/io/atomic_file.hpp"
#include "pcrb_core/io/file_bytes.hpp"
#include "pcrb_core/io/pcd.hpp"

namespace pcrb_tools {
namespace {

namespace fs = std::filesystem;

/// Three million points as text; the published clouds have at most a tenth of that.
constexpr std::uint64_t kMaxCloudBytes = std::uint64_t{1} << 27;

/// What tells the unpacked clouds from others of their names, by name.
using Clouds = std::map<std::string, std::string>;

std::string listFile(const std::string& archive) { return archive + ".unpacked"; }

std::string formatRow(const std::string& name, const std::string& identity) {
  return identity + " " + name + "\n";
}

std::string formatList(const std::string& sha256, const std::string& folder, const Clouds& clouds) {
  std::string text = "archive " + sha256 + "\nfolder " + folder + "\n";
  for (const auto& [name, identity] : clouds) text += formatRow(name, identity);
  return text;
}

/// The clouds of the folder that are still as a list has them.
Clouds findUnchanged(std::string_view list, const std::string& folder) {
  Clouds unchanged;
  if (list.empty() || !fs::is_directory(folder)) return unchanged;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    const std::string identity = fileIdentity(entry.path().string());
    if (list.find("\n" + formatRow(name, identity)) != std::string_view::npos) {
      unchanged[name] = identity;
    }
  }
  return unchanged;
}

bool isCloud(const fs::path& path) {
  return path.extension() == ".pcd" && path.filename().string().front() != '.';
}

}  // namespace

std::size_t unpackClouds(const std::string& archive, const std::string& sha256,
                         const std::string& folder, bool force,
                         const std::function<void()>& on_cloud) {
  std::string list;
  if (fs::is_regular_file(listFile(archive))) list = pcrb::FileBytes(listFile(archive)).text();
  const Clouds unchanged = findUnchanged(list, folder);
  if (!unchanged.empty() && formatList(sha256, folder, unchanged) == list) return unchanged.size();
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
    const std::string origin = archive + "/" + reader.name();
    pcrb::parsePcd(bytes.data(), bytes.data() + bytes.size(), origin);
    const std::string path = folder + "/" + name;
    putPublishedFile(path, bytes, origin, force || unchanged.count(name) > 0);
    clouds[name] = fileIdentity(path);
    if (on_cloud) on_cloud();
  }
  if (clouds.empty()) throw pcrb::InvalidFile(archive, 0, "no .pcd file", "an archive of clouds");
  pcrb::writeFileAtomically(listFile(archive), formatList(sha256, folder, clouds));
  return clouds.size();
}

}  // namespace pcrb_tools
