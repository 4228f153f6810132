#include "report/report_writer.hpp"

#include <cctype>
#include <filesystem>
#include <set>

#include "pcrb_core/error.hpp"
#include "pcrb_core/io/atomic_file.hpp"
#include "pcrb_core/io/file_bytes.hpp"
#include "report/latex.hpp"
#include "report/pivot.hpp"
#include "report/published.hpp"
#include "report/section_tables.hpp"

namespace pcrb_tools {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kWorstShown = 100;

Json describeEntry(const Entry& entry, const std::string& figure) {
  Json json;
  json["method"] = entry.method;
  json["figure"] = figure;
  json["path"] = entry.path;
  json["problems"] = entry.problems.size();
  std::size_t answered = 0;
  for (const ScoredProblem& problem : entry.problems) answered += problem.isAnswered() ? 1 : 0;
  json["answered"] = answered;
  const auto planned = entry.info ? entry.info->problems : std::nullopt;
  const auto trials = static_cast<std::size_t>(entry.trials);
  json["planned"] = planned ? Json(std::to_string(*planned * trials)) : Json(nullptr);
  json["info"] = Json::object();
  if (!entry.info) return json;
  for (const auto& [key, text] : entry.info->writeShown()) json["info"][key] = text;
  return json;
}

/// A method's name in that of a file: without what LaTeX reads otherwise, and unlike the others'.
std::string figureOf(std::string name, std::set<std::string>& taken) {
  for (char& c : name) {
    const bool is_plain = std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '.';
    if (!is_plain) c = '_';
  }
  while (!taken.insert(name).second) name += "_2";
  return name;
}

Json describeEntries(const Section& section) {
  Json list = Json::array();
  std::set<std::string> taken;
  for (const Entry* entry : section.entries) {
    list.push_back(describeEntry(*entry, figureOf(entry->method, taken)));
  }
  return list;
}

Json describeSelections(const Section& section) {
  Json list = Json::array();
  for (const Selection& selection : section.selections) {
    Json json;
    json["name"] = selection.name;
    json["level"] = selection.level;
    const ProblemCounts counts = countProblems(section, selection);
    json["problems"] = counts.all;
    json["shared"] = counts.shared;
    json["published"] = publishedRowOf(section, selection);
    json["sequences"] = Json::array();
    for (const auto& [data_set, sequence] : selection.sequences) {
      json["sequences"].push_back(data_set + "/" + sequence);
    }
    list.push_back(json);
  }
  return list;
}

Json publishedCorrelationsOf(const Section& section) {
  Json list = Json::array();
  for (const PublishedCorrelation& row : publishedCorrelations()) {
    if (row.kind != section.kind) continue;
    Json json;
    json["method"] = row.method;
    json["misalignment"] = row.misalignment;
    json["overlap"] = row.overlap;
    list.push_back(json);
  }
  return list;
}

/// Of figures.py, behind `<kind>_`; histograms have the method's name behind theirs.
constexpr const char* kFigures[] = {"medians",    "solved",   "over_misalignment", "over_overlap",
                                    "over_scans", "overlaps", "components",        "calibration",
                                    "latencies",  "times",    "ranking",           "sweeps"};

/// Paths below the folder of a report, without those of the files that every report has.
std::vector<std::string> filesOf(const Json& report) {
  std::vector<std::string> files{"figures.tex"};
  for (const Json& section : report.at("sections")) {
    const std::string kind = section.at("kind");
    for (const auto& table : section.at("tables").items()) {
      files.push_back("tables/" + kind + "_" + table.key() + ".csv");
    }
    std::vector<std::string> figures(std::begin(kFigures), std::end(kFigures));
    for (const Json& method : section.at("methods")) {
      figures.push_back("histograms_" + method.value("figure", ""));
    }
    for (const std::string& figure : figures) {
      for (const char* extension : {".png", ".pdf"}) {
        files.push_back("figures/" + kind + "_" + figure + extension);
      }
    }
  }
  if (report.contains("trackers") && !report.at("trackers").is_null()) {
    files.emplace_back("tables/tracking_trackers.csv");
    for (std::size_t i = 1; i <= report.at("trackers").at("groups").size(); ++i) {
      for (const char* figure : {"paths_", "errors_"}) {
        for (const char* extension : {".png", ".pdf"}) {
          files.push_back("figures/tracking_" + (figure + std::to_string(i)) + extension);
        }
      }
    }
  }
  return files;
}

/// Sequences whose problems are not the published ones.
Json ownProblemsOf(const Section& section) {
  Json names = Json::array();
  for (const auto& [data_set, sequence] : section.own_problems) {
    names.push_back(data_set + "/" + sequence);
  }
  return names;
}

}  // namespace

ReportWriter::ReportWriter(const ReportOptions& options) : options_(options) {
  std::error_code error;
  fs::create_directories(options.output + "/tables", error);
  if (error) {
    throw pcrb::InvalidFile(options.output, "cannot make this folder: " + error.message());
  }
  json_["title"] = options.title;
  json_["version"] = PCRB_VERSION;
  json_["latex"] = latexRules();
  json_["sections"] = Json::array();
  markdown_ = "# " + options.title + "\n\n";
  latex_ = "% " + options.title +
           ": tables, each to be cut out, or all by \\input\n% \\usepackage{booktabs}\n\n";
}

void ReportWriter::addSection(const Section& section, const std::vector<GroundTruth>& accuracies,
                              const std::string& root) {
  kind_ = pcrb::toString(section.kind);
  markdown_ += "## " + kind_ + " problems\n\n";
  Json json;
  json["kind"] = kind_;
  json["methods"] = describeEntries(section);
  json["baseline"] = section.baseline ? Json(section.baseline->method) : Json(nullptr);
  json["selections"] = describeSelections(section);
  json["tables"] = Json::object();
  tables_ = &json["tables"];
  const Table scores = scoreTable(section, options_);
  const Table comparisons = comparisonTable(section);
  const Table runtimes = runtimeTable(section);
  const Pivot pivot = makePivot(section, scores, comparisons);
  json["pivot"] = toJson(pivot);
  markdown_ += toMarkdown(pivot);
  latex_ += toLatex(pivot, kind_);
  add(scores);
  add(comparisons);
  add(auditTable(section));
  add(correlationTable(section));
  add(recallTable(section, options_));
  add(runtimes);
  add(settlingTable(section));
  add(keepingUpTable(section));
  add(componentTable(section));
  add(covarianceTable(section));
  add(covarianceAxisTable(section));
  add(groundTruthTable(section, accuracies));
  add(trialTable(section));
  add(sweepTable(section, options_));
  add(publishedTable(section));
  add(sequenceTable(section, root));
  addProblems(problemTable(section));
  json["own_problems"] = ownProblemsOf(section);
  json["published_correlations"] = publishedCorrelationsOf(section);
  json["charts"] = chartsOf(section);
  json["charts"]["ranking"] = rankingOf(section, comparisons);
  json["charts"]["times"] = errorsAgainstTimes(scores, runtimes);
  json["worst"] = worstProblems(section);
  json_["sections"].push_back(std::move(json));
}

void ReportWriter::addTrackers(const std::vector<Tracker>& trackers) {
  json_["trackers"] = nullptr;
  if (trackers.empty()) return;
  kind_ = "tracking";
  markdown_ += "## trackers\n\n";
  Json tables = Json::object();
  tables_ = &tables;
  add(trackerTable(trackers));
  json_["trackers"]["table"] = tables["trackers"];
  json_["trackers"]["groups"] = trackerCharts(trackers);
  tables_ = nullptr;
}

void ReportWriter::finish(const Table& summary) {
  write("summary.csv", toCsv(summary));
  write("report.md", markdown_);
  write("report.tex", latex_);
  constexpr auto kReplace = Json::error_handler_t::replace;  // names of files may be any bytes
  write("report.json", json_.dump(1, ' ', false, kReplace) + "\n");
}

void ReportWriter::add(const Table& table) {
  if (table.rows.empty()) return;
  write("tables/" + kind_ + "_" + table.id + ".csv", toCsv(table));
  markdown_ += toMarkdown(table);
  latex_ += toLatex(table, kind_);
  (*tables_)[table.id] = toJson(table);
}

/// The one table that is too long for people.
void ReportWriter::addProblems(Table table) {
  write("tables/" + kind_ + "_" + table.id + ".csv", toCsv(table));
  if (table.rows.size() > kWorstShown) {
    table.note += " These are the worst " + std::to_string(kWorstShown) + " of " +
                  std::to_string(table.rows.size()) + "; tables/" + kind_ + "_" + table.id +
                  ".csv has all.";
    table.rows.resize(kWorstShown);
  }
  (*tables_)[table.id] = toJson(table);
}

void ReportWriter::write(const std::string& name, const std::string& text) const {
  pcrb::writeFileAtomically(options_.output + "/" + name, text);
}

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
