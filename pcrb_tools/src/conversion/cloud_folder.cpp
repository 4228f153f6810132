#include "conversion/cloud_folder.hpp"

#include <array>
#include <filesystem>
#include <memory>
#include <system_error>

#include "pcrb_core/error.hpp"
#include "pcrb_core/io/atomic_file.hpp"
#include "pcrb_core/io/number.hpp"
#include "pcrb_core/io/pcd.hpp"
#include "pcrb_core/io/text.hpp"
#include "pcrb_core/problem/pair_sampling.hpp"

namespace pcrb_tools {
namespace {

void requireFolderName(const std::string& name, const char* what) {
  if (name.empty() || name.front() == '.' || name.find('/') != std::string::npos) {
    throw pcrb::InvalidParameter("found '" + name + "' as name of the " + what +
                                 ", expected a folder's name");
  }
}

std::string conversionFolder(const std::string& root, const std::string& data_set,
                             const std::string& sequence) {
  requireFolderName(data_set, "data set");
  requireFolderName(sequence, "sequence");
  return (std::filesystem::path(root) / data_set / sequence).string();
}

std::string formatCounts(const pcrb::PointCounts& counts) {
  return std::to_string(counts.read) + '\t' + std::to_string(counts.non_finite) + '\t' +
         std::to_string(counts.at_origin) + '\t' + std::to_string(counts.malformed);
}

std::optional<pcrb::PointCounts> parseCounts(const std::string& note) {
  std::array<std::size_t, 4> values{};
  std::vector<std::string_view> fields;
  pcrb::splitAt('\t', note, fields);
  if (fields.size() != values.size()) return std::nullopt;
  for (std::size_t i = 0; i != values.size(); ++i) {
    const auto value = pcrb::parseUnsigned(fields[i]);
    if (!value) return std::nullopt;
    values[i] = *value;
  }
  return pcrb::PointCounts{values[0], values[1], values[2], values[3]};
}

}  // namespace

CloudFolder::CloudFolder(const std::string& root, const std::string& data_set,
                         const std::string& sequence)
    : files_(conversionFolder(root, data_set, sequence),
             conversionFolder(root, data_set, sequence) + "/.conversion") {}

std::optional<pcrb::PointCounts> CloudFolder::kept(const std::string& name,
                                                   const std::string& fingerprint) const {
  const auto note = files_.kept(name, fingerprint);
  return note ? parseCounts(*note) : std::nullopt;
}

std::function<void()> CloudFolder::write(const std::string& name, const std::string& fingerprint,
                                         const pcrb::DatasetCloud& cloud,
                                         const pcrb::PointCounts& counts) {
  files_.begin(name);
  const std::string path = files_.fileOf(name);
  const auto file = std::make_shared<pcrb::AtomicFile>(path);
  pcrb::writePcd(*file, path, cloud);
  return [this, file, name, fingerprint, note = formatCounts(counts)] {
    file->commit();
    files_.record(name, fingerprint, note);
  };
}

std::vector<std::string> CloudFolder::removeStale(const std::set<std::string>& names) {
  std::vector<std::string> removed;
  for (const auto& name : othersThan(names)) {
    if (!files_.isOwn(name)) continue;
    std::error_code error;
    std::filesystem::remove(files_.fileOf(name), error);
    if (error) {
      throw pcrb::InvalidFile(files_.fileOf(name), "cannot be removed: " + error.message());
    }
    removed.push_back(name);
  }
  return removed;
}

std::vector<std::string> CloudFolder::othersThan(const std::set<std::string>& names) const {
  std::vector<std::string> others;
  for (const auto& name : pcrb::findClouds(path())) {
    if (name != pcrb::kMapCloud && names.count(name) == 0) others.push_back(name);
  }
  return others;
}

}  // namespace pcrb_tools
