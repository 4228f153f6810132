#include "scoring/tracking_report.hpp"

#include <cmath>
#include <iomanip>
#include <sstream>

#include "pcrb_core/error.hpp"
#include "pcrb_core/evaluation/trajectory_error.hpp"
#include "pcrb_core/io/number.hpp"

namespace pcrb_tools {
namespace {

constexpr double kDegree = 57.29577951308232;  // per rad

std::vector<double> inDegrees(std::vector<double> angles) {
  for (double& angle : angles) angle *= kDegree;
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

/// Of the scans that have one.
struct Matched {
  pcrb::Poses truth;
  pcrb::Poses estimate;
  std::vector<double> errors;
};

Matched match(const std::vector<TrackedScan>& scans) {
  Matched matched;
  for (const TrackedScan& scan : scans) {
    if (!scan.T_map_sensor) continue;
    matched.truth.push_back(scan.truth);
    matched.estimate.push_back(*scan.T_map_sensor);
    matched.errors.push_back(scan.error->error);
  }
  return matched;
}

}  // namespace

std::string formatScansCsv(const std::vector<TrackedScan>& scans) {
  std::string text = "scan,stamp,error,rotation_error_rad,translation_error_m\n";
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

std::string summarizeTracking(const std::vector<TrackedScan>& scans, std::size_t delta,
                              bool align) {
  const Matched matched = match(scans);
  if (matched.estimate.empty()) {
    throw pcrb::InvalidParameter("found a pose for none of " + std::to_string(scans.size()) +
                                 " scans, expected some with timestamps like the scans'");
  }
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
  appendRow(out, "APE translation m", absolute.translation);
  appendRow(out, "APE rotation deg", inDegrees(absolute.rotation));
  appendRow(out, "RPE translation m", relative.translation);
  appendRow(out, "RPE rotation deg", inDegrees(relative.rotation));
  return out.str();
}

}  // namespace pcrb_tools
