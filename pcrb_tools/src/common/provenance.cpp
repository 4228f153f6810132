#include "common/provenance.hpp"

#include <filesystem>

#include "common/file_identity.hpp"
#include "pcrb_core/error.hpp"
#include "pcrb_core/io/atomic_file.hpp"
#include "pcrb_core/io/file_bytes.hpp"

namespace pcrb_tools {
namespace {

namespace fs = std::filesystem;

constexpr const char* kUnfinished = "unfinished: true\n";

/// A YAML scalar in single quotes.
std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? std::string("''") : std::string(1, c);
  return result + "'";
}

std::string outputLine(const std::string& output) {
  return "output_blake2b: " + pcrb::fileHash(output) + "\n";
}

bool hasBoth(const std::string& output) {
  return fs::is_regular_file(output) && fs::is_regular_file(sideFile(output));
}

/// Removes the temporary files of AtomicFile, `.NAME.PID-N.tmp`, of an output and its side file.
void clearTemporaryFiles(const fs::path& output) {
  const std::string start = "." + output.filename().string() + ".";
  const fs::path folder = output.has_parent_path() ? output.parent_path() : fs::path(".");
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (name.compare(0, start.size(), start) == 0 && entry.path().extension() == ".tmp") {
      fs::remove(entry.path());
    }
  }
}

}  // namespace

std::string sideFile(const std::string& output) { return output + ".yaml"; }

void Provenance::setParameter(const std::string& name, const std::string& value) {
  parameters_.emplace_back(name, value);
}

void Provenance::addInput(const std::string& path) {
  const std::string identity = fileIdentity(path);
  if (identity.empty()) throw pcrb::InvalidFile(path, 0, "nothing", "a file to read");
  inputs_.emplace_back(fs::path(path).filename().string(), identity);
}

std::string Provenance::text() const {
  std::string text = "# What the file of this name without .yaml was made from.\n";
  text += "tool: " + tool_ + "\nparameters:\n";
  for (const auto& [name, value] : parameters_) text += "  " + name + ": " + quoted(value) + "\n";
  text += "inputs:  # name: bytes, time of writing\n";
  for (const auto& [name, identity] : inputs_) text += "  " + quoted(name) + ": " + identity + "\n";
  return text;
}

bool Provenance::isUpToDate(const std::string& output) const {
  return hasBoth(output) && pcrb::FileBytes(sideFile(output)).text() == text() + outputLine(output);
}

bool Provenance::isBegun(const std::string& output) const {
  return hasBoth(output) && pcrb::FileBytes(sideFile(output)).text() == text() + kUnfinished;
}

void Provenance::requireReplaceable(const std::string& output) {
  if (!fs::exists(output)) return;
  if (!fs::is_regular_file(sideFile(output))) {
    throw pcrb::InvalidFile(output,
                            "is there and was not made by this tool; move it away, or "
                            "replace it with --force");
  }
  const pcrb::FileBytes side(sideFile(output));
  if (side.text().find(kUnfinished) != std::string_view::npos) return;
  if (side.text().find(outputLine(output)) == std::string_view::npos) {
    throw pcrb::InvalidFile(output, "was changed since it was made (" + sideFile(output) +
                                        "); move it away, or replace it with --force");
  }
}

void Provenance::begin(const std::string& output) const {
  if (fs::is_directory(fs::absolute(output).parent_path())) clearTemporaryFiles(output);
  pcrb::writeFileAtomically(sideFile(output), text() + kUnfinished);
}

void Provenance::record(const std::string& output) const {
  pcrb::writeFileAtomically(sideFile(output), text() + outputLine(output));
}

}  // namespace pcrb_tools
