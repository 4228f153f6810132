#pragma once

#include <string>
#include <utility>
#include <vector>

namespace pcrb_tools {

/// What an output file was made from: tool, parameters (seeds included) and input files. It is kept
/// as YAML in the side file `<output>.yaml`, by which a rerun sees what is complete and unchanged.
///
/// Inputs count as unchanged if their names, sizes and times of writing are the same: an older file
/// of the same size, as `cp -p` or `tar -x` leaves it, is another one.
class Provenance {
 public:
  explicit Provenance(std::string tool) : tool_(std::move(tool)) {}

  void setParameter(const std::string& name, const std::string& value);

  /// @throws pcrb::InvalidFile  if the file does not exist.
  void addInput(const std::string& path);

  /// What the side file says of tool, parameters and inputs.
  std::string text() const;

  /// Whether the output is there, complete, as it was written, and made from exactly this.
  bool isUpToDate(const std::string& output) const;

  /// Whether the output is there, and begin() was the last to be called for it, with exactly this:
  /// for one that grows, and is always whole as far as it goes.
  bool isBegun(const std::string& output) const;

  /// @throws pcrb::InvalidFile  if the output is there but is not what a side file says: then
  ///                            somebody else made or changed it and a tool must not replace it.
  static void requireReplaceable(const std::string& output);

  /// To be called before an output is written: until record(), it counts as unfinished, so that a
  /// run after a kill makes it again instead of taking it for somebody else's. Clears temporary
  /// files that a killed run has left.
  void begin(const std::string& output) const;

  /// Writes the side file of an output that has just been written.
  void record(const std::string& output) const;

 private:
  std::string tool_;
  std::vector<std::pair<std::string, std::string>> parameters_;
  std::vector<std::pair<std::string, std::string>> inputs_;  ///< name, identity
};

/// Path of an output's side file.
std::string sideFile(const std::string& output);

}  // namespace pcrb_tools
