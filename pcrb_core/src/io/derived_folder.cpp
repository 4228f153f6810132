#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include "pcrb_core/error.hpp"
#include "pcrb_core/io/atomic_file.hpp"
#include "pcrb_core/io/derived_file.hpp"
#include "pcrb_core/io/file_bytes.hpp"
#include "pcrb_core/io/text.hpp"

namespace pcrb {
namespace {

constexpr const char* kWayOn = "; move it away, or replace it with --force (~force of a node)";

[[noreturn]] void throwRecordError(const std::string& path, const char* action) {
  throw InvalidFile(path, std::string("cannot ") + action + ": " + std::strerror(errno));
}

/// What follows the third tab of a whole row; it may be empty.
std::string noteOf(std::string_view line) {
  std::size_t begin = 0;
  for (int tab = 0; tab < 3; ++tab) begin = line.find('\t', begin) + 1;
  return std::string(line.substr(begin));
}

}  // namespace

DerivedFolder::DerivedFolder(std::string path, const std::string& record)
    : path_(std::move(path)), record_(record) {
  std::error_code error;
  std::filesystem::create_directories(path_, error);
  if (error) throw InvalidFile(path_, "cannot be made: " + error.message());
  openRecord();
  readRecord();
  removeTemporaryFiles(path_);
}

DerivedFolder::~DerivedFolder() { close(descriptor_); }

void DerivedFolder::openRecord() {
  descriptor_ = open(record_.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  if (descriptor_ < 0) throwRecordError(record_, "be opened");
  if (flock(descriptor_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
    close(descriptor_);
    throw InvalidFile(path_, "another process is writing this folder");
  }
}

void DerivedFolder::readRecord() {
  const FileBytes bytes(record_);
  const bool is_cut = bytes.size() > 0 && bytes.text().back() != '\n';
  LineReader lines(bytes.text(), record_);
  std::vector<std::string_view> fields;
  for (std::string_view line; lines.next(line);) {
    splitAt('\t', line, fields);
    const std::string name(fields[0]);
    // A name alone, or a part of a row, is of a run that was killed: its file is made again.
    const bool is_whole = fields.size() >= 4 && !(is_cut && lines.rest().empty());
    rows_[name] =
        is_whole ? Row{std::string(fields[1]), std::string(fields[2]), noteOf(line)} : Row{};
  }
  if (is_cut) append('\n' + std::string(fields[0]) + '\n');
}

std::string DerivedFolder::fileOf(const std::string& name) const {
  return (std::filesystem::path(path_) / name).string();
}

std::optional<DerivedFolder::Row> DerivedFolder::find(const std::string& name) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto found = rows_.find(name);
  return found == rows_.end() ? std::nullopt : std::optional(found->second);
}

bool DerivedFolder::isOwn(const std::string& name) const {
  const auto row = find(name);
  return row && !row->identity.empty() && row->identity == fileIdentity(fileOf(name));
}

std::optional<std::string> DerivedFolder::kept(const std::string& name,
                                               const std::string& fingerprint) const {
  const auto row = find(name);
  if (!row || row->fingerprint != fingerprint || !isOwn(name)) return std::nullopt;
  return row->note;
}

void DerivedFolder::requireReplaceable(const std::string& name) const {
  const std::string file = fileOf(name);
  const std::string identity = fileIdentity(file);
  if (identity.empty()) return;
  const auto row = find(name);
  if (!row) throw InvalidFile(file, std::string("is there and was not made by this tool") + kWayOn);
  if (!row->identity.empty() && identity != row->identity) {
    throw InvalidFile(file, std::string("was changed since it was made") + kWayOn);
  }
}

void DerivedFolder::begin(const std::string& name) {
  const std::lock_guard<std::mutex> lock(mutex_);
  append(name + '\n');
  rows_[name] = {};
}

void DerivedFolder::record(const std::string& name, const std::string& fingerprint,
                           const std::string& note) {
  const Row row{fingerprint, fileIdentity(fileOf(name)), note};
  const std::lock_guard<std::mutex> lock(mutex_);
  append(name + '\t' + row.fingerprint + '\t' + row.identity + '\t' + row.note + '\n');
  rows_[name] = row;
}

void DerivedFolder::append(const std::string& text) {
  // One write: after a kill there is a whole row or, at worst, a last one that is cut.
  if (::write(descriptor_, text.data(), text.size()) != static_cast<ssize_t>(text.size())) {
    throwRecordError(path_, "record a file");
  }
}

std::vector<std::string> DerivedFolder::ownFiles() const {
  std::vector<std::string> names;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    for (const auto& [name, row] : rows_) names.push_back(name);
  }
  names.erase(std::remove_if(names.begin(), names.end(),
                             [this](const std::string& name) { return !isOwn(name); }),
              names.end());
  return names;
}

}  // namespace pcrb
