#pragma once

#include "pcd_header.hpp"
#include "pcrb_core/io/text_rows.hpp"
#include "pcrb_core/point_cloud.hpp"

namespace pcrb {

// Readers of what follows a PCD header. `lines` stands behind the DATA entry; they fill points,
// intensity and dropped_non_finite, and throw InvalidFile.

void readPcdAscii(const PcdHeader& header, const LineReader& lines, int threads,
                  DatasetCloud& cloud);
void readPcdBinary(const PcdHeader& header, const LineReader& lines, DatasetCloud& cloud);
void readPcdCompressed(const PcdHeader& header, const LineReader& lines, DatasetCloud& cloud);

}  // namespace pcrb
