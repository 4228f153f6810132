#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace pcrb {

using TableRow = std::vector<std::string>;

/// A table for a terminal: a line per row, columns two spaces apart, each as wide as its widest
/// entry (UTF-8 characters count as one).
///
/// @param rows          all of the same length, at least one.
/// @param text_columns  so many columns at the left are aligned left, the others right.
std::string alignColumns(const std::vector<TableRow>& rows, std::size_t text_columns);

}  // namespace pcrb
