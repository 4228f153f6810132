#include "conversion/cloud_folder.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <system_error>

#include "common/file_identity.hpp"
#include "pcrb_core/error.hpp"
#include "pcrb_core/io/file_bytes.hpp"
#include "pcrb_core/io/number.hpp"
#include "pcrb_core/io/pcd.hpp"
#include "pcrb_core/io/text.hpp"
#include "pcrb_core/problem/pair_sampling.hpp"

namespace pcrb_tools {
namespace {

namespace fs = std::filesystem;

constexpr const char* kRecordFile = ".conversion";
constexpr std::size_t kRecordFields = 7;

[[noreturn]] void throwSystemError(const std::string& path, const char* action) {
  throw pcrb::InvalidFile(path, std::string("cannot ") + action + ": " + std::strerror(errno));
}

void requireFolderName(const std::string& name, const char* what) {
  if (name.empty() || name.front() == '.' || name.find('/') != std::string::npos) {
    throw pcrb::InvalidParameter("found '" + name + "' as name of the " + what +
                                 ", expected a folder's name");
  }
}

/// Names of writePcd's temporary files: `.NAME.pcd.PID-N.tmp`.
bool isTemporaryName(const std::string& name) {
  constexpr std::size_t kEnd = 4;
  return name.size() > kEnd && name.front() == '.' &&
         name.compare(name.size() - kEnd, kEnd, ".tmp") == 0 &&
         name.find(".pcd.") != std::string::npos;
}

std::string formatCounts(const pcrb::PointCounts& counts) {
  return std::to_string(counts.read) + '\t' + std::to_string(counts.non_finite) + '\t' +
         std::to_string(counts.at_origin) + '\t' + std::to_string(counts.malformed);
}

bool parseCounts(const std::string_view* fields, pcrb::PointCounts& counts) {
  std::array<std::size_t, 4> values{};
  for (std::size_t i = 0; i != values.size(); ++i) {
    const auto value = pcrb::parseUnsigned(fields[i]);
    if (!value) return false;
    values[i] = *value;
  }
  counts = {values[0], values[1], values[2], values[3]};
  return true;
}

}  // namespace

std::string fingerprintOf(const std::string& description) {
  std::uint64_t hash = 0xcbf29ce484222325U;
  for (const char c : description) {
    hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3U;
  }
  std::string text;
  for (int shift = 60; shift >= 0; shift -= 4) text += "0123456789abcdef"[hash >> shift & 0xf];
  return text;
}

CloudFolder::CloudFolder(const std::string& root, const std::string& data_set,
                         const std::string& sequence)
    : path_((fs::path(root) / data_set / sequence).string()) {
  requireFolderName(data_set, "data set");
  requireFolderName(sequence, "sequence");
  std::error_code error;
  fs::create_directories(path_, error);
  if (error) throw pcrb::InvalidFile(path_, "cannot be made: " + error.message());
  openRecords();
  readRecords();
  clearTemporaryFiles();
}

CloudFolder::~CloudFolder() { close(descriptor_); }

void CloudFolder::openRecords() {
  const std::string file = (fs::path(path_) / kRecordFile).string();
  descriptor_ = open(file.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  if (descriptor_ < 0) throwSystemError(file, "be opened");
  if (flock(descriptor_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
    close(descriptor_);
    throw pcrb::InvalidFile(path_, "another conversion is writing this folder");
  }
}

void CloudFolder::readRecords() {
  const pcrb::FileBytes bytes((fs::path(path_) / kRecordFile).string());
  pcrb::LineReader lines(bytes.text(), kRecordFile);
  std::string_view line;
  std::vector<std::string_view> fields;
  while (lines.next(line)) {
    pcrb::splitAt('\t', line, fields);
    pcrb::PointCounts counts;
    // A name alone, or a part of a row, is of a run that was killed: its cloud is made again.
    if (fields.size() != kRecordFields || !parseCounts(&fields[3], counts)) {
      records_[std::string(fields[0])] = {};
      continue;
    }
    records_[std::string(fields[0])] = {std::string(fields[1]), std::string(fields[2]), counts};
  }
  const bool cut = bytes.size() > 0 && bytes.text().back() != '\n';
  if (cut && ::write(descriptor_, "\n", 1) != 1) throwSystemError(path_, "record a cloud");
}

void CloudFolder::clearTemporaryFiles() const {
  for (const auto& entry : fs::directory_iterator(path_)) {
    if (isTemporaryName(entry.path().filename().string())) fs::remove(entry.path());
  }
}

std::optional<pcrb::PointCounts> CloudFolder::kept(const std::string& name,
                                                   const std::string& fingerprint) const {
  const auto found = find(name);
  if (!found || found->fingerprint != fingerprint) return std::nullopt;
  const std::string identity = fileIdentity(fileOf(name));
  if (identity.empty() || identity != found->file_identity) return std::nullopt;
  return found->counts;
}

void CloudFolder::requireReplaceable(const std::string& name) const {
  constexpr const char* kWayOn =
      "; move it away, or replace it with the converter's --force (~force of a node)";
  const std::string file = fileOf(name);
  const std::string identity = fileIdentity(file);
  if (identity.empty()) return;
  const auto found = find(name);
  if (!found) {
    throw pcrb::InvalidFile(file, std::string("is there and was not made by a converter") + kWayOn);
  }
  if (!found->file_identity.empty() && identity != found->file_identity) {
    throw pcrb::InvalidFile(file, std::string("was changed since it was converted") + kWayOn);
  }
}

void CloudFolder::write(const std::string& name, const std::string& fingerprint,
                        const pcrb::DatasetCloud& cloud, const pcrb::PointCounts& counts) {
  record(name, {});  // after a kill, a cloud without its row is known to be of a conversion
  pcrb::writePcd(fileOf(name), cloud);
  record(name, {fingerprint, fileIdentity(fileOf(name)), counts});
}

std::string CloudFolder::fileOf(const std::string& name) const {
  return (fs::path(path_) / name).string();
}

std::optional<CloudFolder::Record> CloudFolder::find(const std::string& name) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto found = records_.find(name);
  return found == records_.end() ? std::nullopt : std::optional(found->second);
}

void CloudFolder::record(const std::string& name, const Record& record) {
  std::string row = name;
  if (!record.file_identity.empty()) {
    row += '\t' + record.fingerprint + '\t' + record.file_identity + '\t' +
           formatCounts(record.counts);
  }
  row += '\n';
  const std::lock_guard<std::mutex> lock(mutex_);
  // One write: after a kill there is a whole row or, at worst, a last one that is cut.
  if (::write(descriptor_, row.data(), row.size()) != static_cast<ssize_t>(row.size())) {
    throwSystemError(path_, "record a cloud");
  }
  records_[name] = record;
}

std::vector<std::string> CloudFolder::removeStale(const std::set<std::string>& names) {
  std::vector<std::string> removed;
  for (const auto& name : othersThan(names)) {
    const auto found = find(name);
    if (!found || found->file_identity != fileIdentity(fileOf(name))) continue;
    std::error_code error;
    fs::remove(fileOf(name), error);
    if (error) throw pcrb::InvalidFile(fileOf(name), "cannot be removed: " + error.message());
    removed.push_back(name);
  }
  return removed;
}

std::vector<std::string> CloudFolder::othersThan(const std::set<std::string>& names) const {
  std::vector<std::string> others;
  for (const auto& name : pcrb::findClouds(path_)) {
    if (name != pcrb::kMapCloud && names.count(name) == 0) others.push_back(name);
  }
  return others;
}

}  // namespace pcrb_tools
