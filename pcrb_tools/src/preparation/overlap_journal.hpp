#pragma once

#include <cstddef>
#include <fstream>
#include <map>
#include <string>
#include <vector>

namespace pcrb_tools {

/// The columns of an overlap matrix that are done, in a text file that grows line by line.
///
/// The first part is what the matrix is made from; a journal with another one is begun anew. A last
/// line that an interruption cut short is dropped.
class OverlapJournal {
 public:
  /// @param made_from  text of several lines that ends with a newline.
  /// @param size       number of values of a column.
  /// @throws pcrb::InvalidFile  if the file cannot be read or written.
  OverlapJournal(std::string path, const std::string& made_from, std::size_t size);

  /// Columns by target that were done before.
  const std::map<std::size_t, std::vector<double>>& known() const { return known_; }

  /// @throws pcrb::InvalidFile  if the line cannot be written.
  void append(std::size_t target, const std::vector<double>& column);

  /// Removes the file, when the matrix is complete.
  void remove();

 private:
  /// Length of the part of the file that is kept; 0 = nothing.
  std::size_t readKnown(const std::string& made_from, std::size_t size);

  std::string path_;
  std::map<std::size_t, std::vector<double>> known_;
  std::ofstream file_;
};

}  // namespace pcrb_tools
