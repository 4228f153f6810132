#include "report/former_files.hpp"

#include <filesystem>
#include <vector>

#include "pcrb_core/io/file_bytes.hpp"
#include "report/table.hpp"

namespace pcrb_tools {
namespace {

namespace fs = std::filesystem;

/// Of figures.py, behind `<kind>_`; histograms have the method's name behind theirs.
constexpr const char* kFigures[] = {"medians",      "solved",   "over_misalignment",
                                    "over_overlap", "overlaps", "components"};

/// Paths below the folder of a report, without those of the files that every report has.
std::vector<std::string> filesOf(const Json& report) {
  std::vector<std::string> files;
  for (const Json& section : report.at("sections")) {
    const std::string kind = section.at("kind");
    for (const auto& table : section.at("tables").items()) {
      files.push_back("tables/" + kind + "_" + table.key() + ".csv");
    }
    std::vector<std::string> figures(std::begin(kFigures), std::end(kFigures));
    for (const Json& method : section.at("methods")) {
      figures.push_back("histograms_" + method.at("method").get<std::string>());
    }
    for (const std::string& figure : figures) {
      for (const char* extension : {".png", ".pdf"}) {
        files.push_back("figures/" + kind + "_" + figure + extension);
      }
    }
  }
  return files;
}

}  // namespace

void removeFormerFiles(const std::string& folder) {
  const std::string report = folder + "/report.json";
  if (!fs::is_regular_file(report)) return;
  try {
    for (const std::string& file : filesOf(Json::parse(pcrb::FileBytes(report).text()))) {
      if (file.find("..") == std::string::npos) fs::remove(folder + "/" + file);
    }
  } catch (const Json::exception&) {
    // Not a report of ours: then none of the files is.
  }
}

}  // namespace pcrb_tools
