#pragma once

#include <string>

#include "pcrb_core/io/atomic_file.hpp"
#include "pcrb_core/point_cloud.hpp"

namespace pcrb {

/// Writes what writePcd() writes into a file whose commit is left to the caller, who may have other
/// things to do while the disk takes it.
///
/// @param path  for messages
/// @throws InvalidFile  if it cannot be written, or a point is not finite.
void writePcd(AtomicFile& file, const std::string& path, const DatasetCloud& cloud);

}  // namespace pcrb
