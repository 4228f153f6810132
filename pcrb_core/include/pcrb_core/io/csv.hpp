#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "pcrb_core/io/text.hpp"

namespace pcrb {

/// Appends a field of a row of comma-separated values, quoted where it must be to be read back as
/// it is (RFC 4180).
void appendCsvField(std::string& line, std::string_view field);

/// Takes the next row of comma-separated values (RFC 4180): a field in quotes may hold commas,
/// doubled quotes and line ends, which come out as line feeds. Blanks around a field without quotes
/// are removed, blank lines between rows passed over.
///
/// @param fields  replaced by the row's.
/// @return        false behind the last row.
/// @throws InvalidFile  if a quote does not end, or text follows a closing quote.
bool nextCsvRow(LineReader& lines, std::vector<std::string>& fields);

}  // namespace pcrb
