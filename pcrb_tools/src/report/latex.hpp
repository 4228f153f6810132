#pragma once

#include <cstddef>
#include <string>

#include "report/table.hpp"

namespace pcrb_tools {

constexpr std::size_t kLatexLetters = 78;  ///< of \footnotesize in a page's width, with gaps
constexpr std::size_t kLatexGap = 3;       ///< letters between two columns

/// Text as LaTeX reads it, whatever letters it has. Words may go on in the next line after so many.
std::string latexEscaped(const std::string& text, std::size_t unbroken = std::string::npos);

/// The rules of latexEscaped, for captions that are made elsewhere: what stands in the place of
/// which `letters`, the first and last letter of the `ranges` that are left as they are (others
/// become `?`), and the number of letters after which a long word may be broken (`unbroken`).
Json latexRules();

/// A `table` with booktabs around rows that are there already.
///
/// @param caption  LaTeX.
/// @param columns  of the `tabular`.
/// @param body     header, `\midrule`, rows.
std::string latexTable(const std::string& caption, const std::string& label,
                       const std::string& columns, const std::string& body);

/// A table of the report as `table`s that fit a page each: columns that do not fit beside each
/// other follow in a further one with the same first columns, rows likewise. Labels are
/// `tab:pcrb-<kind>-<id>`, with `-2` and so on from the second part on; the caption is title and
/// note. Needs the package booktabs.
std::string toLatex(const Table& table, const std::string& kind);

}  // namespace pcrb_tools
