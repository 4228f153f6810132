#include "report/trackers.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "common/series_file.hpp"
#include "pcrb_core/datasets/pose_file.hpp"
#include "pcrb_core/error.hpp"
#include "pcrb_core/evaluation/statistics.hpp"
#include "pcrb_core/io/csv.hpp"
#include "pcrb_core/io/file_bytes.hpp"
#include "pcrb_core/io/number.hpp"
#include "pcrb_core/io/text.hpp"
#include "pcrb_core/transform.hpp"
#include "report/entries.hpp"

namespace pcrb_tools {
namespace {

constexpr std::size_t kMapSquares = 4000;  // drawn at most

double finiteField(const pcrb::LineReader& lines, const std::string& field) {
  const auto value = pcrb::parseDouble(field);
  if (!value || !std::isfinite(*value)) lines.fail(pcrb::inQuotes(field), "a finite number");
  return *value;
}

/// Rows of a file of scans, with the stamps of all and of those that have a pose.
void readScans(const std::string& path, Tracker& tracker, std::vector<pcrb::Stamp>& posed) {
  const pcrb::FileBytes file(path);
  pcrb::LineReader lines(file.text(), path);
  std::string_view header;
  if (!lines.next(header) || header != kScansHeader) {
    throw pcrb::InvalidFile(path, 1, pcrb::inQuotes(header),
                            std::string("the header ") + kScansHeader);
  }
  std::vector<std::string> fields;
  std::optional<pcrb::Stamp> first;
  while (pcrb::nextCsvRow(lines, fields)) {
    if (fields.size() != 6) lines.fail(std::to_string(fields.size()) + " fields", "6");
    const auto stamp = pcrb::parseStamp(fields[1]);
    if (!stamp) lines.fail(pcrb::inQuotes(fields[1]), "a timestamp");
    if (!first) first = *stamp;
    TrackerScan scan;
    scan.name = fields[0];
    scan.time = static_cast<double>(*stamp - *first) * 1e-9;
    scan.held_error = finiteField(lines, fields[5]);
    if (!fields[2].empty()) {
      scan.error = finiteField(lines, fields[2]);
      posed.push_back(*stamp);
    }
    tracker.scans.push_back(scan);
  }
  if (posed.empty()) throw pcrb::InvalidFile(path, 0, "no scan with a pose", "one at least");
}

pcrb::Poses readPath(const std::string& path, const std::vector<pcrb::Stamp>& stamps) {
  const pcrb::FileBytes file(path);
  const pcrb::Trajectory trajectory = pcrb::parseTrajectory(file.text(), path).trajectory;
  pcrb::Poses poses;
  for (const pcrb::Stamp stamp : stamps) {
    const pcrb::StampedPose& pose = trajectory.nearest(stamp);
    if (pose.stamp != stamp) {
      throw pcrb::InvalidFile(path, 0, "no pose at " + pcrb::formatStamp(stamp),
                              "one of each scan that has an error in scans.csv");
    }
    poses.push_back(pose.T_world_body);
  }
  return poses;
}

std::vector<std::pair<double, double>> readMapSquares(const std::string& path) {
  std::vector<std::pair<double, double>> squares;
  if (!std::filesystem::is_regular_file(path)) return squares;  // then none is drawn
  const pcrb::FileBytes file(path);
  pcrb::LineReader lines(file.text(), path);
  std::vector<std::string> fields;
  pcrb::nextCsvRow(lines, fields);
  while (pcrb::nextCsvRow(lines, fields)) {
    if (fields.size() != 2) lines.fail(std::to_string(fields.size()) + " fields", "x,y");
    squares.emplace_back(finiteField(lines, fields[0]), finiteField(lines, fields[1]));
  }
  return squares;
}

double rmse(const std::vector<double>& errors) { return pcrb::describeErrors(errors).rmse; }

std::vector<Json> trackerRow(const Tracker& tracker) {
  std::vector<double> errors, held;
  for (const TrackerScan& scan : tracker.scans) {
    if (scan.error) errors.push_back(*scan.error);
    held.push_back(scan.held_error);
  }
  const auto absolute = pcrb::absolutePoseErrors(tracker.truth, tracker.estimate);
  const auto steps = pcrb::relativePoseErrors(tracker.truth, tracker.estimate, 1);
  const auto metres = pcrb::relativePoseErrorsOver(tracker.truth, tracker.estimate, 1.0);
  const pcrb::Drift drift = pcrb::drift(tracker.truth, tracker.estimate);
  return {tracker.name,
          tracker.scans.size(),
          tracker.scans.size() - tracker.truth.size(),
          number(tracker.completeness()),
          number(pcrb::describe(errors).median),
          number(pcrb::describe(held).median),
          number(rmse(absolute.translation)),
          number(rmse(absolute.rotation) * pcrb::kDegreesPerRadian),
          number(rmse(steps.translation)),
          number(rmse(steps.rotation) * pcrb::kDegreesPerRadian),
          number(rmse(metres.translation)),
          number(rmse(metres.rotation) * pcrb::kDegreesPerRadian),
          number(drift.translation_percent),
          number(drift.rotation_degrees_per_metre),
          tracker.truth.size() == tracker.scans.size() ? "complete" : "incomplete"};
}

bool haveTheSameScans(const Tracker& a, const Tracker& b) {
  return std::equal(a.scans.begin(), a.scans.end(), b.scans.begin(), b.scans.end(),
                    [](const TrackerScan& x, const TrackerScan& y) { return x.name == y.name; });
}

Json positionsOf(const pcrb::Poses& poses) {
  Json list = Json::array();
  for (const auto& pose : poses) list.push_back({pose.translation().x(), pose.translation().y()});
  return list;
}

Json mapOf(const Tracker& tracker) {
  Json list = Json::array();
  const std::size_t step = tracker.map.size() / kMapSquares + 1;
  for (std::size_t i = 0; i < tracker.map.size(); i += step) {
    list.push_back({tracker.map[i].first, tracker.map[i].second});
  }
  return list;
}

Json pathOf(const Tracker& tracker) {
  Json json;
  json["name"] = tracker.name;
  json["path"] = positionsOf(tracker.estimate);
  json["errors"] = Json::array();
  for (const TrackerScan& scan : tracker.scans) {
    json["errors"].push_back({scan.time, number(scan.error)});
  }
  return json;
}

}  // namespace

std::vector<Tracker> loadTrackers(const std::vector<std::string>& folders) {
  std::vector<Tracker> trackers;
  for (const std::string& text : folders) {
    const NamedPath place = parseNamed(text);
    Tracker tracker;
    tracker.folder = place.path;
    tracker.name = place.name.empty() ? lastName(place.path) : place.name;
    for (const Tracker& other : trackers) {
      if (other.name != tracker.name) continue;
      throw pcrb::InvalidParameter("found two trackers called `" + tracker.name + "`, " +
                                   other.folder + " and " + tracker.folder +
                                   ": name them apart, NAME=FOLDER");
    }
    std::vector<pcrb::Stamp> posed;
    readScans(place.path + "/scans.csv", tracker, posed);
    tracker.truth = readPath(place.path + "/truth.tum", posed);
    tracker.estimate = readPath(place.path + "/estimate.tum", posed);
    tracker.map = readMapSquares(place.path + "/map.csv");
    trackers.push_back(std::move(tracker));
  }
  return trackers;
}

Table trackerTable(const std::vector<Tracker>& trackers) {
  Table table{
      "trackers",
      "Trackers",
      "Of the scans of a sequence: how many were lost, the median of the benchmark's error "
      "of the others, and of all, a lost one with the last pose before it; root mean squares "
      "of absolute (APE) and relative (RPE) pose errors, these over one scan and one metre "
      "of path; KITTI's drift: t_rel in % of the path, r_rel in degrees per metre. Errors of "
      "what was not lost flatter a tracker that loses much.",
      {{"tracker"},
       {"scans", Format::kCount},
       {"lost", Format::kCount},
       {"completeness", Format::kFraction}},
      {}};
  for (const char* name :
       {"error", "error, lost held", "APE m", "APE deg", "RPE scan m", "RPE scan deg",
        "RPE metre m", "RPE metre deg", "t_rel %", "r_rel deg/m"}) {
    table.columns.push_back({name, Format::kError});
  }
  table.columns.push_back({"verdict"});
  for (const Tracker& tracker : trackers) table.rows.push_back(trackerRow(tracker));
  return table;
}

Json trackerCharts(const std::vector<Tracker>& trackers) {
  std::vector<const Tracker*> firsts;  // of each group
  Json groups = Json::array();
  for (const Tracker& tracker : trackers) {
    const auto known = std::find_if(firsts.begin(), firsts.end(), [&](const Tracker* first) {
      return haveTheSameScans(*first, tracker);
    });
    const auto place = static_cast<std::size_t>(known - firsts.begin());
    if (known == firsts.end()) {
      firsts.push_back(&tracker);
      Json group;
      group["map"] = mapOf(tracker);
      group["truth"] = Json::array();
      group["trackers"] = Json::array();
      groups.push_back(group);
    }
    if (tracker.truth.size() > groups[place]["truth"].size()) {
      groups[place]["truth"] = positionsOf(tracker.truth);
    }
    groups[place]["trackers"].push_back(pathOf(tracker));
  }
  return groups;
}

}  // namespace pcrb_tools
