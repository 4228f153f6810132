#pragma once

#include <string>
#include <vector>

#include "report/details.hpp"
#include "report/report_tool.hpp"
#include "report/section.hpp"
#include "report/table.hpp"
#include "report/trackers.hpp"

namespace pcrb_tools {

/// Gathers the parts of a report and writes its files, all but those that Python draws.
class ReportWriter {
 public:
  /// Makes the folder. The options must outlive the writer.
  /// @throws pcrb::InvalidFile  if the folder cannot be made.
  explicit ReportWriter(const ReportOptions& options);

  /// Writes the tables of one kind of problems.
  void addSection(const Section& section, const std::vector<GroundTruth>& accuracies,
                  const std::string& root);

  /// Writes what is said of trackers; nothing if there are none.
  void addTrackers(const std::vector<Tracker>& trackers);

  /// Writes what has all sections.
  void finish(const Table& summary);

 private:
  void add(const Table& table);
  void addProblems(Table table);
  void write(const std::string& name, const std::string& text) const;

  const ReportOptions& options_;
  std::string kind_;
  std::string markdown_;
  std::string latex_;
  Json json_;
  Json* tables_ = nullptr;  ///< of the section that is being added
};

/// Removes the tables and figures of the report that a folder holds, so that none of them lies
/// beside the next report's. Its report.json says which they are; other files stay.
void removeFormerFiles(const std::string& folder);

}  // namespace pcrb_tools
