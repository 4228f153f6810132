#pragma once

#include <set>
#include <string>
#include <utility>
#include <vector>

#include "report/section.hpp"

namespace pcrb_tools {

/// Sequences (data set, sequence) of which some entry has problems that are not the published ones,
/// whatever their name: a tool drew them, as the run table or the problem file's side file says; or
/// an id is none that the published files have.
///
/// @param root  data set folder where problem files are looked for; may be empty.
std::set<std::pair<std::string, std::string>> findOwnProblems(
    const std::vector<const Entry*>& entries, const std::string& root);

/// Names of the sequences in own_problems, separated by commas.
std::string namesOfOwnProblems(const Section& section);

/// The row of the paper's tables that may stand beside a selection: its sequence's name or `total`;
/// empty if there is none or the problems are others. The total is one of all published sequences
/// and stands only beside theirs.
std::string publishedRowOf(const Section& section, const Selection& selection);

}  // namespace pcrb_tools
