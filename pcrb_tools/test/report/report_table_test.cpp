#include <gtest/gtest.h>

#include <limits>

#include "report/scored_problem.hpp"
#include "report/table.hpp"

namespace pcrb_tools {
namespace {

Table someTable() {
  return {
      "some",
      "Some_table",
      "How to read it.",
      {{"method"}, {"n", Format::kCount}, {"error", Format::kError}, {"p", Format::kProbability}},
      {{"a,\"b\"", 3, 0.123456789, 0.0001}, {"c_d", 4, nullptr, 0.25}}};
}

TEST(ReportTable, IsExactAndQuotedInCsv) {
  EXPECT_EQ(toCsv(someTable()),
            "method,n,error,p\n\"a,\"\"b\"\"\",3,0.123456789,1e-04\nc_d,4,,0.25\n");
}

TEST(ReportTable, IsRoundedAndEscapedInMarkdownAndLatex) {
  EXPECT_EQ(
      toMarkdown(someTable()),
      "### Some_table\n\nHow to read it.\n\n| method | n | error | p |\n|---|---:|---:|---:|\n"
      "| a,\"b\" | 3 | 0.1235 | \\<0.001 |\n| c\\_d | 4 | - | 0.250 |\n\n");
  const std::string latex = toLatex(someTable());
  EXPECT_NE(latex.find("\\caption{Some\\_table}"), std::string::npos);
  EXPECT_NE(latex.find("c\\_d & 4 & - & 0.250 \\\\\n"), std::string::npos);
  EXPECT_NE(latex.find("$<$0.001"), std::string::npos);
}

TEST(ReportTable, HasNullInJsonWhereANumberIsNotFinite) {
  EXPECT_TRUE(number(std::numeric_limits<double>::quiet_NaN()).is_null());
  EXPECT_EQ(toJson(someTable())["rows"][1][2].dump(), "null");
  EXPECT_EQ(toJson(someTable())["columns"][1]["format"], "count");
}

TEST(PairOfAProblem, IsFoundFromItsCloudsElseFromItsOfficialId) {
  ScoredProblem problem;
  problem.key = {"eth", "plain", pcrb::Kind::kLocal, "4215528470029"};
  EXPECT_EQ(pairOf(problem), "eth/plain pair 0");
  problem.key.problem_id = "4215528470062";
  EXPECT_EQ(pairOf(problem), "eth/plain pair 2");
  problem.key.problem_id = "17";
  EXPECT_EQ(pairOf(problem), "eth/plain problem 17");
  problem.source = "a.pcd";
  problem.target = "b.pcd";
  EXPECT_EQ(pairOf(problem), "eth/plain a.pcd b.pcd");
}

}  // namespace
}  // namespace pcrb_tools
