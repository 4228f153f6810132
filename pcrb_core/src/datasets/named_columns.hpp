#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "pcrb_core/io/text.hpp"
#include "pcrb_core/transform.hpp"

namespace pcrb {

/// Rows of comma-separated values below a row of names: fields are found by what their column
/// means. Lines with one field before the names, and rows that begin with `#`, are comments.
class NamedColumns {
 public:
  using Meaning = std::function<std::string(const std::string& name)>;

  /// @param name      stands for the path in messages
  /// @param meaning   of a column's name; of columns of one meaning the first counts
  /// @param expected  for messages: the columns that are wanted
  /// @throws InvalidFile  if there is no row of names.
  NamedColumns(std::string_view text, const std::string& name, const Meaning& meaning,
               const std::string& expected);

  bool has(const std::string& meaning) const { return places_.count(meaning) > 0; }

  /// Whether there is the upper part of a matrix: `00` … `23` behind a prefix.
  bool hasMatrix(const std::string& prefix) const;

  /// Of all columns, as they are written.
  const std::vector<std::string>& names() const { return names_; }

  /// The name of the column that means this.
  const std::string& nameOf(const std::string& meaning) const {
    return names_[places_.at(meaning)];
  }

  /// Takes the next row; false behind the last one.
  /// @throws InvalidFile  if it has fewer fields than there are names.
  bool next();

  /// Of the row taken last.
  const std::string& field(const std::string& meaning) const {
    return fields_[places_.at(meaning)];
  }

  /// @throws InvalidFile  if it is no finite number.
  double number(const std::string& meaning) const;

  /// The pose of hasMatrix()'s columns.
  /// @throws InvalidFile  also if they are no pose.
  Transform pose(const std::string& prefix) const;

  /// For errors about the row taken last.
  const LineReader& reader() const { return reader_; }

 private:
  LineReader reader_;
  std::vector<std::string> names_;
  std::map<std::string, std::size_t> places_;
  std::vector<std::string> fields_;
};

}  // namespace pcrb
