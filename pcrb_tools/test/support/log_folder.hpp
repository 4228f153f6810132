#pragma once

#include <archive.h>
#include <archive_entry.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace pcrb_test {

using NamedFiles = std::vector<std::pair<std::string, std::string>>;

inline void writeFile(const std::string& path, const std::string& bytes) {
  std::filesystem::create_directories(std::filesystem::path(path).parent_path());
  std::ofstream file(path, std::ios::binary);
  file << bytes;
  if (!file.flush()) throw std::runtime_error("cannot write " + path);
}

inline std::string readFile(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

inline void writeFiles(const std::string& folder, const NamedFiles& files) {
  for (const auto& [name, bytes] : files) writeFile(folder + '/' + name, bytes);
}

/// Bytes that do not compress.
inline std::string noise(std::size_t size) {
  std::mt19937 random(1);
  std::string bytes;
  for (std::size_t i = 0; i < size; ++i) bytes += static_cast<char>(random() & 0xFF);
  return bytes;
}

/// Changes 64 bytes of a file.
inline void damage(const std::string& path, std::size_t offset) {
  std::string bytes = readFile(path);
  for (std::size_t i = offset; i < offset + 64; ++i) {
    bytes.at(i) = static_cast<char>(bytes.at(i) ^ 0x55);
  }
  writeFile(path, bytes);
}

/// Names in a folder, hidden ones included, sorted.
inline std::vector<std::string> namesIn(const std::string& folder) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    names.push_back(entry.path().filename().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

/// Writes an archive with the names as they are, however hostile: zip by the path's end, else tgz.
inline void writeArchive(const std::string& path, const NamedFiles& files) {
  const std::unique_ptr<archive, int (*)(archive*)> writer(archive_write_new(),
                                                           &archive_write_free);
  if (std::filesystem::path(path).extension() == ".zip") {
    archive_write_set_format_zip(writer.get());
  } else {
    archive_write_set_format_gnutar(writer.get());
    archive_write_add_filter_gzip(writer.get());
  }
  if (archive_write_open_filename(writer.get(), path.c_str()) != ARCHIVE_OK) {
    throw std::runtime_error("cannot write " + path);
  }
  for (const auto& [name, bytes] : files) {
    const std::unique_ptr<archive_entry, void (*)(archive_entry*)> entry(archive_entry_new(),
                                                                         &archive_entry_free);
    archive_entry_set_pathname(entry.get(), name.c_str());
    archive_entry_set_size(entry.get(), static_cast<la_int64_t>(bytes.size()));
    archive_entry_set_filetype(entry.get(), AE_IFREG);
    archive_entry_set_perm(entry.get(), 0644);
    if (archive_write_header(writer.get(), entry.get()) != ARCHIVE_OK ||
        archive_write_data(writer.get(), bytes.data(), bytes.size()) < 0) {
      throw std::runtime_error("cannot write " + name + " into " + path);
    }
  }
}

}  // namespace pcrb_test
