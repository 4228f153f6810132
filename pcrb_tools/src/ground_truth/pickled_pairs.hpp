#pragma once

#include <string>

namespace pcrb_tools {

/// Whether a file's name is that of a published ground-truth evaluation, `<sequence>_gt_check.dat`.
bool isPickled(const std::string& path);

/// The sequence that such a file's name says.
std::string sequenceOfPickled(const std::string& path);

/// The rows of a published ground-truth evaluation as text, with the header of readPairFile.
///
/// The file is two Python pickles, one behind the other: the command (texts), then the rows (lists
/// of numbers). Only lists, texts and numbers are read: a pickle that makes any other object, or
/// calls anything, is refused.
/// @throws pcrb::InvalidFile  with the byte where it stops being such a file; or if its rows have 6
///                            numbers: an earlier evaluation, without a misalignment.
std::string readPickledPairs(const std::string& path);

}  // namespace pcrb_tools
