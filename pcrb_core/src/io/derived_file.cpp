#include "pcrb_core/io/derived_file.hpp"

#include <sys/stat.h>

#include <algorithm>
#include <filesystem>

#include "pcrb_core/error.hpp"
#include "pcrb_core/io/atomic_file.hpp"
#include "pcrb_core/io/file_bytes.hpp"
#include "pcrb_core/io/text.hpp"

namespace pcrb {
namespace {

namespace fs = std::filesystem;

constexpr const char* kUnfinished = "unfinished: true\n";
constexpr std::string_view kTool = "tool: ";
constexpr const char* kOutput = "output_blake2b: ";

/// A YAML scalar in single quotes.
std::string yamlScalar(const std::string& text) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? std::string("''") : std::string(1, c);
  return result + "'";
}

std::string outputLine(const std::string& path) { return kOutput + fileHash(path) + "\n"; }

bool sideFileSays(const std::string& path, const std::string& text) {
  return fs::is_regular_file(path) && fs::is_regular_file(sideFile(path)) &&
         FileBytes(sideFile(path)).text() == text;
}

std::vector<std::string> linesOf(const std::string& path) {
  std::vector<std::string> lines;
  if (!fs::is_regular_file(path)) return lines;
  const FileBytes bytes(path);
  LineReader reader(bytes.text(), path);
  for (std::string_view line; reader.next(line);) lines.emplace_back(line);
  return lines;
}

/// The lines of one list that another does not have.
std::string listMissing(const std::vector<std::string>& lines,
                        const std::vector<std::string>& from) {
  std::string text;
  for (const std::string& line : lines) {
    if (std::find(from.begin(), from.end(), line) == from.end()) text += " `" + line + "`";
  }
  return text.empty() ? " nothing" : text;
}

}  // namespace

std::string fileIdentity(const std::string& path) {
  struct stat status {};
  if (stat(path.c_str(), &status) != 0) return {};
  return std::to_string(status.st_size) + ' ' + std::to_string(status.st_mtim.tv_sec) + '.' +
         std::to_string(status.st_mtim.tv_nsec);
}

std::string sideFile(const std::string& path) { return path + ".yaml"; }

bool isForeign(const std::string& path) { return fs::exists(path) && !fs::exists(sideFile(path)); }

std::string generatorOf(const std::string& path, const std::string& hash) {
  std::string tool;
  bool is_of_this_file = false;
  for (const std::string& line : linesOf(sideFile(path))) {
    if (startsWith(line, kTool)) tool = trimmed(line).substr(kTool.size());
    is_of_this_file = is_of_this_file || line == kOutput + hash;
  }
  return is_of_this_file ? tool : std::string();
}

void DerivedFile::setParameter(const std::string& name, const std::string& value) {
  parameters_.emplace_back(name, value);
}

void DerivedFile::addInput(const std::string& path) {
  const std::string identity = fileIdentity(path);
  if (identity.empty()) throw InvalidFile(path, 0, "nothing", "a file to read");
  inputs_.emplace_back(fs::path(path).filename().string(), identity);
}

std::string DerivedFile::text() const {
  std::string text = "# What the file of this name without .yaml was made from.\n";
  text += std::string(kTool) + tool_ + "\nparameters:\n";
  for (const auto& [name, value] : parameters_) {
    text += "  " + name + ": " + yamlScalar(value) + "\n";
  }
  text += "inputs:  # name: bytes, time of writing\n";
  for (const auto& [name, identity] : inputs_) {
    text += "  " + yamlScalar(name) + ": " + identity + "\n";
  }
  return text;
}

bool DerivedFile::isUpToDate() const {
  return fs::is_regular_file(path_) && sideFileSays(path_, text() + outputLine(path_));
}

bool DerivedFile::isBegun() const { return sideFileSays(path_, text() + kUnfinished); }

void DerivedFile::requireReplaceable() const {
  if (!fs::exists(path_)) return;
  if (!fs::is_regular_file(sideFile(path_))) {
    throw InvalidFile(path_,
                      "is there and was not made by this tool; move it away, or replace it with "
                      "--force");
  }
  const FileBytes side(sideFile(path_));
  if (side.text().find(kUnfinished) != std::string_view::npos) return;
  if (side.text().find(outputLine(path_)) == std::string_view::npos) {
    throw InvalidFile(path_, "was changed since it was made (" + sideFile(path_) +
                                 "); move it away, or replace it with --force");
  }
}

void DerivedFile::begin() const {
  const fs::path folder = fs::absolute(path_).parent_path();
  if (fs::is_directory(folder)) {
    removeTemporaryFiles(folder.string(), fs::path(path_).filename().string());
  }
  writeFileAtomically(sideFile(path_), text() + kUnfinished);
}

void DerivedFile::record() const {
  writeFileAtomically(sideFile(path_), text() + outputLine(path_));
}

void claimFolder(const std::string& folder, const std::string& note,
                 const std::vector<std::string>& lines, OtherFiles others) {
  if (fs::exists(folder) && !fs::is_directory(folder)) {
    throw InvalidFile(folder, 0, "a file", "a folder");
  }
  const std::string path = (fs::path(folder) / note).string();
  const std::vector<std::string> found = linesOf(path);
  if (found == lines) return;
  if (!found.empty()) {
    throw InvalidFile(path, "the folder holds something else: found" + listMissing(found, lines) +
                                ", asked for" + listMissing(lines, found) +
                                "; give another folder, or the settings of this one");
  }
  if (others == OtherFiles::kRefused && fs::exists(folder) && !fs::is_empty(folder)) {
    throw InvalidFile(folder, 0, "a folder with other files", "a new or empty one");
  }
  fs::create_directories(folder);
  writeFileAtomically(path, joined(lines, "\n") + "\n");
}

}  // namespace pcrb
