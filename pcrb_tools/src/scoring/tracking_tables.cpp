#include "scoring/tracking_tables.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>
#include <string>
#include <vector>

#include "common/series_file.hpp"
#include "pcrb_core/io/number.hpp"

namespace pcrb_tools {
namespace {

std::vector<double> inDegrees(std::vector<double> angles) {
  for (double& angle : angles) angle *= pcrb::kDegreesPerRadian;
  return angles;
}

void appendTum(std::string& text, pcrb::Stamp stamp, const pcrb::Transform& T) {
  const Eigen::Quaterniond q = Eigen::Quaterniond(T.linear()).normalized();
  const Eigen::Vector3d& t = T.translation();
  text += pcrb::formatStamp(stamp);
  for (const double number : {t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w()}) {
    text += ' ';
    pcrb::appendShortest(text, number);
  }
  text += '\n';
}

void appendRow(std::ostream& out, const std::string& name, const std::vector<double>& errors) {
  const pcrb::ErrorStatistics s = pcrb::describeErrors(errors);
  out << std::left << std::setw(20) << name << std::right << std::setw(6) << s.count;
  for (const double value : {s.rmse, s.mean, s.median, s.stddev, s.min, s.max, s.sse}) {
    out << "  " << std::setw(10)
        << (std::isnan(value) ? std::string("-") : pcrb::formatFixed(value, 6));
  }
  out << '\n';
}

std::size_t lostOf(const std::vector<TrackedScan>& scans) {
  return static_cast<std::size_t>(std::count_if(
      scans.begin(), scans.end(), [](const TrackedScan& scan) { return !scan.T_map_sensor; }));
}

std::string verdictOn(const std::vector<TrackedScan>& scans, const TrackingOptions& options) {
  const std::size_t lost = lostOf(scans);
  if (lost == 0) return "verdict: complete\n";
  const std::string limit = pcrb::formatShortest(options.max_lost);
  return "lost " + std::to_string(lost) + " of " + std::to_string(scans.size()) +
         " scans; in `lost held` each counts with the last pose before it\nverdict: " +
         (isComplete(scans, options) ? "complete enough: no more lost than --max-lost " + limit
                                     : "incomplete: more lost than --max-lost " + limit) +
         "\n";
}

}  // namespace

Matched match(const std::vector<TrackedScan>& scans) {
  Matched matched;
  for (const TrackedScan& scan : scans) {
    matched.held_errors.push_back(scan.held_error);
    if (!scan.T_map_sensor) continue;
    matched.truth.push_back(scan.truth);
    matched.estimate.push_back(*scan.T_map_sensor);
    matched.errors.push_back(scan.error->error);
  }
  return matched;
}

std::string formatScansCsv(const std::vector<TrackedScan>& scans) {
  std::string text = kScansHeader + std::string("\n");
  for (const TrackedScan& scan : scans) {
    text += scan.name + ',' + pcrb::formatStamp(scan.stamp);
    if (scan.error) {
      for (const double value :
           {scan.error->error, scan.error->rotation_error, scan.error->translation_error}) {
        text += ',';
        pcrb::appendShortest(text, value);
      }
    } else {
      text += ",,,";
    }
    text += ',';
    pcrb::appendShortest(text, scan.held_error);
    text += '\n';
  }
  return text;
}

std::string formatTruthTum(const std::vector<TrackedScan>& scans) {
  std::string text;
  for (const TrackedScan& scan : scans) {
    if (scan.T_map_sensor) appendTum(text, scan.stamp, scan.truth);
  }
  return text;
}

std::string formatEstimateTum(const std::vector<TrackedScan>& scans) {
  std::string text;
  for (const TrackedScan& scan : scans) {
    if (scan.T_map_sensor) appendTum(text, scan.stamp, *scan.T_map_sensor);
  }
  return text;
}

std::string summarizeTracking(const std::vector<TrackedScan>& scans,
                              const TrackingOptions& options) {
  const std::size_t delta = options.delta;
  const bool align = options.align;
  const Matched matched = match(scans);
  const auto absolute = pcrb::absolutePoseErrors(
      matched.truth,
      align ? pcrb::alignToReference(matched.truth, matched.estimate) : matched.estimate);
  const auto relative = pcrb::relativePoseErrors(matched.truth, matched.estimate, delta);
  std::ostringstream out;
  out << "scans " << scans.size() << ", with a pose " << matched.estimate.size() << "; APE "
      << (align ? "after a rigid alignment" : "without alignment") << ", RPE over " << delta
      << (delta == 1 ? " scan\n" : " scans\n");
  out << "                     count        rmse        mean      median      stddev         min"
         "         max         sse\n";
  appendRow(out, "error", matched.errors);
  appendRow(out, "error, lost held", matched.held_errors);
  appendRow(out, "APE translation m", absolute.translation);
  appendRow(out, "APE rotation deg", inDegrees(absolute.rotation));
  appendRow(out, "RPE translation m", relative.translation);
  appendRow(out, "RPE rotation deg", inDegrees(relative.rotation));
  const auto over_metres =
      pcrb::relativePoseErrorsOver(matched.truth, matched.estimate, options.metres);
  const std::string name = "RPE " + pcrb::formatShortest(options.metres) + " m ";
  appendRow(out, name + "m", over_metres.translation);
  appendRow(out, name + "deg", inDegrees(over_metres.rotation));
  const pcrb::Drift drift = pcrb::drift(matched.truth, matched.estimate);
  if (drift.segments > 0) {
    out << "drift over " << pcrb::formatShortest(drift.lengths.front()) << " to "
        << pcrb::formatShortest(drift.lengths.back()) << " m: t_rel "
        << pcrb::formatFixed(drift.translation_percent, 4) << " %, r_rel "
        << pcrb::formatFixed(drift.rotation_degrees_per_metre, 6) << " deg/m\n";
  }
  out << verdictOn(scans, options);
  return out.str();
}

bool isComplete(const std::vector<TrackedScan>& scans, const TrackingOptions& options) {
  return static_cast<double>(lostOf(scans)) <= options.max_lost * static_cast<double>(scans.size());
}

}  // namespace pcrb_tools
