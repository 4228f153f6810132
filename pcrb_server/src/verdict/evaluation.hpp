#pragma once

#include <pcrb_msgs/Summary.h>

#include "verdict/junit_report.hpp"
#include "verdict/threshold.hpp"

namespace pcrb {

/// The verdict on a run: one test for the run itself and one per row of its summary, with every
/// number as a property; the table, and every breach of a threshold, as printed text.
JunitReport judge(const pcrb_msgs::Summary& summary, const Thresholds& thresholds);

/// The verdict on a run that has no summary.
JunitReport judgeUnfinished(const std::string& why);

}  // namespace pcrb
