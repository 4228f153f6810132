#include <gtest/gtest.h>

#include "report/section_tables.hpp"
#include "support/report_fixture.hpp"

namespace pcrb_tools {
namespace {

/// An entry of twelve pairs with two problems each, whose errors have `normalized` standard
/// deviations in x alone.
Entry entryOf(const std::string& method, double normalized) {
  Entry entry;
  entry.method = method;
  entry.path = method;
  for (int i = 0; i < 24; ++i) {
    ScoredProblem problem;
    problem.key = {"eth", "plain", pcrb::Kind::kLocal, std::to_string(10 + i)};
    problem.pair = std::to_string(i / 2);
    problem.components.emplace();
    problem.covariance.emplace();
    for (std::size_t axis = 0; axis < 6; ++axis) (*problem.covariance)[7 * axis] = 0.04;
    pcrb::PoseErrorVector error = pcrb::PoseErrorVector::Zero();
    error[0] = 0.2 * normalized;
    problem.judged = pcrb::judgeCovariance(error, *problem.covariance);
    entry.problems.push_back(problem);
  }
  return entry;
}

Json cellOf(const Table& table, const std::string& method, const std::string& column) {
  for (const auto& row : table.rows) {
    if (row[0] != method) continue;
    for (std::size_t i = 0; i < table.columns.size(); ++i) {
      if (table.columns[i].name == column) return row[i];
    }
  }
  return nullptr;
}

TEST(CovarianceTable, SaysWhichMethodIsTooSureOfItself) {
  std::vector<Entry> entries{entryOf("sure", 6.0), entryOf("unsure", 0.1)};
  entries[0].problems[3].judged.reset();
  const auto sections = makeSections(entries, "");
  const Table table = covarianceTable(sections[0]);
  EXPECT_EQ(cellOf(table, "sure", "judged"), 23);
  EXPECT_EQ(cellOf(table, "sure", "not judged"), 1);
  EXPECT_NEAR(cellOf(table, "sure", "mean NEES").get<double>(), 6.0, 1e-9);
  EXPECT_EQ(cellOf(table, "sure", "inside 95 %"), 0.0);
  EXPECT_EQ(cellOf(table, "sure", "verdict"), "overconfident");
  EXPECT_EQ(cellOf(table, "unsure", "inside 50 %"), 1.0);
  EXPECT_EQ(cellOf(table, "unsure", "verdict"), "underconfident");
  const Table axes = covarianceAxisTable(sections[0]);
  EXPECT_NEAR(cellOf(axes, "sure", "rms").get<double>(), 6.0, 1e-9);
  EXPECT_NEAR(cellOf(axes, "sure", "stated").get<double>(), 0.2, 1e-12);
  const Json curves = calibrationCurves(sections[0]);
  EXPECT_EQ(curves["curves"].size(), 2u);
  EXPECT_EQ(curves["curves"][0]["fractions"].back(), 1.0);
}

TEST(CovarianceTable, HasNoRowWhereNoReplyCameWithACovarianceOrTheTruthIsNotKnown) {
  std::vector<Entry> entries{entryOf("a", 1.0), entryOf("b", 1.0)};
  for (auto& problem : entries[0].problems) problem.covariance.reset(), problem.judged.reset();
  for (auto& problem : entries[1].problems) problem.components.reset(), problem.judged.reset();
  const auto sections = makeSections(entries, "");
  EXPECT_TRUE(covarianceTable(sections[0]).rows.empty());
  EXPECT_TRUE(covarianceAxisTable(sections[0]).rows.empty());
  EXPECT_TRUE(calibrationCurves(sections[0])["curves"].empty());
}

TEST(SequenceTable, SaysWhoAssignedTheCharacteristics) {
  std::vector<Entry> entries{entryOf("a", 1.0)};
  for (auto& problem : entries[0].problems) problem.overlap = 0.5;
  entries[0].problems[0].overlap = 0.25;
  entries[0].problems[23].key.sequence = "yard";
  entries[0].problems[23].key.data_set = "own";
  const auto sections = makeSections(entries, "");
  const Table table = sequenceTable(sections[0], "");
  EXPECT_EQ(cellOf(table, "plain", "assigned by"), "this suite");
  EXPECT_EQ(cellOf(table, "plain", "pairs"), 12);
  EXPECT_EQ(cellOf(table, "plain", "least overlap"), 0.25);
  EXPECT_EQ(cellOf(table, "plain", "largest overlap"), 0.5);
  EXPECT_EQ(cellOf(table, "yard", "assigned by"), "");
}

}  // namespace
}  // namespace pcrb_tools
