#include "conversion/conversion_report.hpp"

#include <filesystem>
#include <iostream>
#include <sstream>

#include "pcrb_core/problem/problem.hpp"

namespace pcrb_tools {
namespace {

constexpr std::size_t kNamesShown = 5;

void appendCount(std::ostringstream& text, std::size_t count, const char* what) {
  if (count > 0) text << ", " << count << ' ' << what;
}

/// A few names; the whole list would fill the terminal.
std::string someOf(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i != names.size() && i != kNamesShown; ++i) {
    text += (i > 0 ? ", " : "") + names[i];
  }
  return names.size() > kNamesShown ? text + ", …" : text;
}

}  // namespace

std::size_t ConversionReport::scansDropped() const {
  std::size_t count = 0;
  for (const auto& [reason, names] : dropped) count += names.size();
  return count;
}

std::string formatReport(const ConversionReport& report) {
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text << report.sequence << ": " << report.scans_read << " scans read, " << report.written.size()
       << " written";
  if (report.scans_kept > 0) text << " (" << report.scans_kept << " kept from an earlier run)";
  text << ", " << report.scansDropped() << " dropped\n";
  if (!report.removed.empty()) {
    text << "  removed, as this run does not make them: " << report.removed.size()
         << " clouds of earlier runs (" << someOf(report.removed) << ")\n";
  }
  for (const auto& [reason, names] : report.dropped) {
    text << "  dropped, " << reason << ": " << names.size() << " (" << someOf(names) << ")\n";
  }
  const pcrb::PointCounts& points = report.points;
  text << "  " << points.read << " points read, " << points.written() << " written";
  appendCount(text, points.non_finite, "dropped as not finite or without depth");
  appendCount(text, points.at_origin, "dropped at (0, 0, 0)");
  appendCount(text, points.malformed, "lines dropped that are no point");
  text << '\n';
  for (const auto& note : report.notes) text << "  note: " << note << '\n';
  return text.str();
}

std::vector<std::string> describeMissingClouds(const ConversionRequest& request,
                                               const ConversionReport& report) {
  namespace fs = std::filesystem;
  const fs::path folder = fs::path(request.root) / request.data_set / report.sequence;
  std::vector<std::string> lines;
  for (const char* kind : {"_local.txt", "_global.txt"}) {
    const fs::path file = folder.parent_path() / (report.sequence + kind);
    if (!fs::exists(file)) continue;
    std::set<std::string> missing;
    for (const auto& problem : pcrb::readProblemFile(file.string())) {
      for (const auto& name : {problem.source, problem.target}) {
        if (report.written.count(name) == 0 && !fs::exists(folder / name)) missing.insert(name);
      }
    }
    for (const auto& name : missing) {
      lines.push_back(file.filename().string() + " names " + name + ", which is not in " +
                      folder.string());
    }
  }
  return lines;
}

void printReport(const ConversionRequest& request, const ConversionReport& report) {
  std::cout << formatReport(report);
  for (const auto& line : describeMissingClouds(request, report)) {
    std::cout << "  missing: " << line << '\n';
  }
  std::cout << std::flush;
}

}  // namespace pcrb_tools
