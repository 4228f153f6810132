#pragma once

#include "report/report_tool.hpp"
#include "report/section.hpp"
#include "report/table.hpp"

namespace pcrb_tools {

/// Registration recall at the options' (m, °) pairs, per method and selection of all levels.
Table recallTable(const Section& section, const ReportOptions& options);

/// Quantiles of latency (source published to reply received) and of the solver's own time.
Table runtimeTable(const Section& section);

/// Bias and spread of the answered problems' errors in x y z (m) and roll pitch yaw (degrees). No
/// rows where no run has them.
Table componentTable(const Section& section);

/// Every problem, worst first.
Table problemTable(const Section& section);

}  // namespace pcrb_tools
