#include "conversion/log_files.hpp"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <set>
#include <system_error>
#include <utility>

#include "archives/archive_reader.hpp"
#include "pcrb_core/error.hpp"
#include "pcrb_core/io/derived_file.hpp"
#include "pcrb_core/io/pcd.hpp"

namespace pcrb_tools {
namespace {

namespace fs = std::filesystem;

/// Bytes that the texts read at once of one archive may have together: some hours of KAIST's poses.
constexpr std::uint64_t kMaxTexts = std::uint64_t{1} << 28;

/// Largest file of its kind that is read from an archive, bytes. Real ones: 0.5 MB for the 30,000
/// points of a velodyne's turn; 22 MB for a CSV of 365,000 points; 70 MB for an hour of poses.
std::uint64_t largestSize(const LogFile& file) {
  const bool is_velodyne = fs::path(file.name).extension() == ".bin";
  return std::uint64_t{1} << (is_velodyne ? 24 : 27);
}

bool isHidden(const std::string& file_name) { return !file_name.empty() && file_name[0] == '.'; }

std::vector<fs::directory_entry> sortedEntries(const std::string& folder) {
  std::error_code error;
  std::vector<fs::directory_entry> entries;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
    if (!isHidden(it->path().filename().string())) entries.push_back(*it);
  }
  if (error) throw pcrb::InvalidFile(folder, "cannot be listed: " + error.message());
  std::sort(entries.begin(), entries.end(), [](const auto& a, const auto& b) {
    return pcrb::naturalLess(a.path().string(), b.path().string());
  });
  return entries;
}

}  // namespace

std::string LogFile::path() const {
  return name.empty() ? container : (fs::path(container) / name).string();
}

std::string LogFile::fileName() const { return fs::path(path()).filename().string(); }

std::string LogFile::folder() const { return name.substr(0, name.find_last_of('/') + 1); }

LogFiles::LogFiles(const std::vector<std::string>& inputs, const Predicate& read_at_once) {
  for (const auto& input : inputs) addInput(input);
  for (std::size_t i = 0; i != files_.size(); ++i) {
    if (read_at_once(files_[i])) texts_.emplace(i, read(i).text());
  }
  for (const auto& path : archives_) addArchive(path, read_at_once);
  if (files_.empty()) {
    throw pcrb::InvalidFile(inputs.empty() ? "input" : inputs.front(), 0, "no file", "a log");
  }
}

void LogFiles::addInput(const std::string& input) {
  std::error_code error;
  const fs::file_status status = fs::status(input, error);
  if (fs::is_directory(status)) {
    std::vector<std::string> visited;
    addFolder(input, "", visited);
  } else if (!fs::is_regular_file(status)) {
    throw pcrb::InvalidFile(input, 0, fs::exists(status) ? "a special file" : "nothing",
                            "a folder, an archive or a file of a log");
  } else if (isArchiveName(input)) {
    archives_.push_back(input);
  } else {
    files_.push_back({input, "", false, pcrb::fileIdentity(input)});
  }
}

void LogFiles::addFolder(const std::string& container, const std::string& folder,
                         std::vector<std::string>& visited) {
  const std::string path = (fs::path(container) / folder).string();
  // Links to folders are followed, but not in circles.
  const std::string place = fs::canonical(path).string();
  if (std::find(visited.begin(), visited.end(), place) != visited.end()) return;
  visited.push_back(place);
  for (const auto& entry : sortedEntries(path)) {
    const std::string name = folder + entry.path().filename().string();
    std::error_code error;
    if (entry.is_directory(error)) {
      addFolder(container, name + '/', visited);
    } else if (entry.is_regular_file(error)) {
      const std::string file = entry.path().string();
      if (isArchiveName(file)) {
        archives_.push_back(file);
      } else {
        files_.push_back({container, name, false, pcrb::fileIdentity(file)});
      }
    }
  }
}

void LogFiles::addArchive(const std::string& path, const Predicate& read_at_once) {
  const std::string identity = pcrb::fileIdentity(path);
  std::set<std::string> names;
  ArchiveReader reader(path);
  std::uint64_t left = std::min(kMaxTexts, reader.sizeLimit());
  while (reader.next()) {
    LogFile file{path, reader.name(), true, identity};
    if (isHidden(file.fileName())) continue;
    if (!names.insert(file.name).second) {
      throw pcrb::InvalidFile(file.path(), "is in the archive twice");
    }
    if (read_at_once(file)) {
      std::string text = reader.read(std::min(left, largestSize(file)));
      left -= text.size();
      texts_.emplace(files_.size(), std::move(text));
    }
    files_.push_back(std::move(file));
  }
}

std::vector<std::size_t> LogFiles::find(const Predicate& wanted) const {
  std::vector<std::size_t> indices;
  for (std::size_t i = 0; i != files_.size(); ++i) {
    if (wanted(files_[i])) indices.push_back(i);
  }
  return indices;
}

std::size_t LogFiles::findOne(const std::string& file_name) const {
  const auto found = find([&](const LogFile& file) { return file.fileName() == file_name; });
  if (found.size() == 1) return found.front();
  throw pcrb::InvalidFile(files_.front().container, 0,
                          std::to_string(found.size()) + " files " + file_name, "one");
}

pcrb::FileBytes LogFiles::read(std::size_t index) const {
  return pcrb::FileBytes(files_.at(index).path());
}

void LogFiles::readArchived(const std::vector<std::size_t>& indices, const Taker& take) const {
  std::map<std::string, std::map<std::string, std::size_t>> wanted;
  for (const std::size_t index : indices) {
    const LogFile& file = files_.at(index);
    if (file.in_archive) wanted[file.container].emplace(file.name, index);
  }
  for (auto& [path, names] : wanted) {
    ArchiveReader reader(path);
    while (!names.empty() && reader.next()) {
      const auto found = names.find(reader.name());
      if (found == names.end()) continue;
      take(found->second, reader.read(largestSize(files_[found->second])));
      names.erase(found);
    }
    if (!names.empty()) throw pcrb::InvalidFile(path, "changed while it was read");
  }
}

namespace fs = std::filesystem;

SpoolFolder::SpoolFolder(const std::string& folder)
    : folder_((fs::path(folder) / ".spool").string()) {
  fs::remove_all(folder_);
}

SpoolFolder::~SpoolFolder() {
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
}

void SpoolFolder::write(std::size_t number, const std::string& bytes) const {
  fs::create_directories(folder_);
  std::ofstream file(path(number), std::ios::binary);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  file.close();
  if (!file) throw pcrb::InvalidFile(path(number), "cannot be written");
}

std::string SpoolFolder::path(std::size_t number) const {
  return (fs::path(folder_) / std::to_string(number)).string();
}

}  // namespace pcrb_tools
