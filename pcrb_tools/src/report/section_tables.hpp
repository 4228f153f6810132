#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "report/report_tool.hpp"
#include "report/section.hpp"
#include "report/table.hpp"

namespace pcrb_tools {

/// Pairs of clouds below which no interval is given: Wilcoxon's test of five cannot reject either.
constexpr std::size_t kFewestPairs = 6;

/// The 95 % bootstrap interval of a median over pairs of clouds.
struct MedianInterval {
  Json low, high;  ///< null for fewer pairs than kFewestPairs
  std::size_t pairs = 0;
};
MedianInterval medianIntervalOf(const Problems& problems, const ReportOptions& options);

/// Statistics of the error and outcomes, a row per method and selection of all levels, the medians
/// with their confidence intervals; the baseline comes last.
Table scoreTable(const Section& section, const ReportOptions& options);

/// `method,sequence,median,q75,q95,mean,stddev`: sequences and totals of all sections. A method
/// that has both kinds is called `method (kind)`.
Table summaryTable(const std::vector<Section>& sections);

/// The paper's statistics of the section's methods and sequences, as published.
Table publishedTable(const Section& section);

/// Level below which a corrected p-value counts as a real difference.
constexpr double kSignificance = 0.05;

/// The verdict of a test that so few pairs of clouds could not make reject.
constexpr const char* kTooFewPairs = "too few pairs to tell";

/// The smallest p that Wilcoxon's test of so many pairs can give.
inline double smallestP(std::size_t pairs) {
  return 2.0 * std::pow(0.5, static_cast<double>(pairs));
}

/// Wilcoxon's test of every two methods on the problems that both have, pairs of clouds as units
/// (their median errors), over everything and per sequence; Holm's correction within either family.
/// The verdict names the better method, or says that none is shown, or that so few pairs could show
/// none. Then each method against the baseline, in two families of their own.
Table comparisonTable(const Section& section);

/// Whether a method's score comes from what its client remembered: the first problem that was posed
/// of each pair of clouds against the later ones, and a run without an audit against an audited one
/// of the same problems and the same `under_test`. No rows where no run had a client and several
/// problems of a pair.
Table auditTable(const Section& section);

/// Spearman's ρ of the error against the initial misalignment and the overlap: per sequence and
/// pooled, with all problems and without the unanswered ones, whose error is the misalignment.
Table correlationTable(const Section& section);

/// Registration recall at the options' (m, °) pairs, per method and selection of all levels.
Table recallTable(const Section& section, const ReportOptions& options);

/// Quantiles of latency (source published to reply received) and of the solver's own time.
Table runtimeTable(const Section& section);

/// Bias and spread of the answered problems' errors in x y z (m) and roll pitch yaw (degrees). No
/// rows where no run has them.
Table componentTable(const Section& section);

/// What the rules `first`, `stable` and `deadline` make of the stored answers of localization
/// nodes. No rows where no run has them.
Table settlingTable(const Section& section);

/// Scans of localization nodes: sent, unanswered, latency, processor share. No rows without any.
Table keepingUpTable(const Section& section);

/// Quartiles of the error after each scan, a panel per sequence; a problem that ended before keeps
/// its last answer.
Json errorsOverScans(const Section& section);

/// Whether the replies' covariances are as large as their errors, per method, sequence and total.
/// No rows where no reply came with one.
Table covarianceTable(const Section& section);

/// The same for each axis, in total.
Table covarianceAxisTable(const Section& section);

/// `probabilities`, and per method the fraction of errors in the ellipsoid of each.
Json calibrationCurves(const Section& section);

/// How much repeated runs differ, per method and selection. No rows where none was repeated.
Table trialTable(const Section& section);

/// The median over the values of a swept parameter, with its interval. No rows without a sweep.
Table sweepTable(const Section& section, const ReportOptions& options);

/// What the sequences are (the paper's Tables 2 and 3) and what problems of them are here: data
/// set, characteristics and who assigned them, pairs, their overlaps.
///
/// @param root  folder of the data sets; may be empty.
Table sequenceTable(const Section& section, const std::string& root);

/// Of three methods and more, what a critical-difference diagram shows: `pairs` of clouds that all
/// methods have, `methods` with their mean `rank` by the pair's median error, best first, and
/// `cliques`: neighbours in that order of whom no test shows a difference. Else null.
/// Source: Demsar, Statistical comparisons of classifiers over multiple data sets, JMLR 2006, with
/// Wilcoxon's test and Holm's correction in place of Nemenyi's (Benavoli et al., JMLR 2016).
Json rankingOf(const Section& section, const Table& comparisons);

/// Each method's median error against its median time, whose quantiles are known; `is_front` where
/// no other method is as fast and as good, and better in either.
Json errorsAgainstTimes(const Table& scores, const Table& runtimes);

/// The worst problems of each method, with the command that shows exactly that one of a run.
Json worstProblems(const Section& section);

/// Every problem, worst first.
Table problemTable(const Section& section);

/// Numbers that are drawn and are in no table: `thresholds` and `solved` (fraction of problems
/// solved over the error threshold, per method), `over_misalignment` and `over_overlap` (quartiles
/// of the error in bins, per data set and method), `over_scans`, `histograms` (of the error, per
/// sequence and method, with median, mean and standard deviation) and `overlaps` (of the pairs, per
/// sequence, in the ten intervals of overlap that pairs are drawn from), `calibration`
/// (calibrationCurves()).
Json chartsOf(const Section& section);

}  // namespace pcrb_tools
