#include "report/published.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "pcrb_core/io/number.hpp"
#include "support/report_fixture.hpp"
#include "support/shared_data.hpp"

namespace pcrb_tools {
namespace {

std::string published(const std::string& name) {
  return pcrb_test::sharedData() + "/paper_results/" + name;
}

TEST(Published, RowsAreThePapersTables4To7And9To11CellByCell) {
  PCRB_REQUIRE_SHARED_DATA();
  auto expected = readCsv(published("tables.csv"));
  const auto rows = publishedRows();
  ASSERT_EQ(rows.size(), expected.size());
  ASSERT_EQ(rows.size(), 7u * 16u);
  for (auto& row : expected) {
    const auto same = std::find_if(rows.begin(), rows.end(), [&](const PublishedRow& ours) {
      return ours.method == row["method"] && ours.sequence == row["sequence"];
    });
    ASSERT_NE(same, rows.end()) << row["method"] << " " << row["sequence"];
    std::size_t column = 0;
    for (const char* name : {"median", "q75", "q95", "mean", "stddev"}) {
      EXPECT_EQ(pcrb::formatFixed(same->statistics.at(column++), 2), row.at(name))
          << row["method"] << " " << row["sequence"] << " " << name;
    }
  }
}

TEST(Published, CorrelationsAreThePapersTable8) {
  PCRB_REQUIRE_SHARED_DATA();
  auto expected = readCsv(published("correlations.csv"));
  const auto rows = publishedCorrelations();
  ASSERT_EQ(rows.size(), expected.size());
  for (auto& row : expected) {
    const auto same = std::find_if(rows.begin(), rows.end(), [&](const PublishedCorrelation& ours) {
      return ours.method == row["method"];
    });
    ASSERT_NE(same, rows.end()) << row["method"];
    EXPECT_EQ(pcrb::formatFixed(same->misalignment, 4), row.at("rho_misalignment"));
    EXPECT_EQ(pcrb::formatFixed(same->overlap, 4), row.at("rho_overlap"));
  }
}

}  // namespace
}  // namespace pcrb_tools
