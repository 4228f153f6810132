#include <iostream>
#include <sstream>

#include "conversion/conversion.hpp"

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

void printReport(const ConversionRequest& request, const ConversionReport& report) {
  std::cout << formatReport(report);
  for (const auto& line : describeMissingClouds(request, report)) {
    std::cout << "  missing: " << line << '\n';
  }
  std::cout << std::flush;
}

}  // namespace pcrb_tools
