#include "report/report_tool.hpp"

#include <ros/package.h>

#include <string>
#include <vector>

#include "common/process.hpp"
#include "pcrb_core/error.hpp"
#include "report/details.hpp"
#include "report/entries.hpp"
#include "report/report_writer.hpp"
#include "report/section_tables.hpp"

namespace pcrb_tools {
namespace {

constexpr const char* kPython = PCRB_PYTHON;  // the interpreter that CMake found

void addOverlaps(ProblemDetails& details, Section& section) {
  for (const Selection* selection : section.at({"sequence"})) {
    const auto& [data_set, sequence] = *selection->sequences.begin();
    auto overlaps = details.overlapsOf(data_set, sequence, section.kind);
    if (overlaps.empty()) continue;
    section.overlaps[{data_set, sequence}] = std::move(overlaps);
    const auto range = details.overlapRangeOf(data_set, sequence, section.kind);
    if (range) section.overlap_ranges[{data_set, sequence}] = *range;
  }
}

}  // namespace

void writeReportData(const ReportOptions& options) {
  std::vector<GroundTruth> accuracies;
  if (!options.ground_truth.empty()) accuracies = readGroundTruth(options.ground_truth);
  std::vector<Entry> entries = loadEntries(options);
  const std::vector<Tracker> trackers = loadTrackers(options.trackers);
  DetailsByRoot details = addDetails(options, accuracies, entries);
  const std::string root = details.empty() ? std::string() : details.begin()->first;
  std::vector<Section> sections = makeSections(entries, root);
  for (Section& section : sections) {
    if (details.size() == 1) addOverlaps(details.begin()->second, section);
  }
  removeFormerFiles(options.output);
  ReportWriter writer(options);
  for (const Section& section : sections) writer.addSection(section, accuracies, root);
  writer.addTrackers(trackers);
  writer.finish(summaryTable(sections));
}

void runReportTool(const ReportOptions& options) {
  writeReportData(options);
  const std::string script = ros::package::getPath("pcrb_tools") + "/report/draw_report.py";
  std::vector<std::string> command{kPython, "-B", script, options.output};
  if (!options.draw_figures) command.emplace_back("--no-figures");
  const int status = runChild(command);
  if (status != 0) {
    throw pcrb::Error("drawing " + options.output + " failed with status " +
                      std::to_string(status) + " (see above); what was computed is there");
  }
}

}  // namespace pcrb_tools
