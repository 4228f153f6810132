#include <gtest/gtest.h>

#include <limits>

#include "report/latex.hpp"
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
      "| a,\"b\" | 3 | 0.123 | \\<0.001 |\n| c\\_d | 4 | - | 0.250 |\n\n");
  const std::string latex = toLatex(someTable(), "local");
  EXPECT_NE(latex.find("\\caption{Some\\_table, local problems. How to read it.}"),
            std::string::npos);
  EXPECT_NE(latex.find("c\\_d & 4 & - & 0.250 \\\\\n"), std::string::npos);
  EXPECT_NE(latex.find("$<$0.001"), std::string::npos);
}

TEST(ReportTable, IsDividedInLatexIntoPartsThatFitAPageWithLabelsOfTheirOwn) {
  Table table{"wide", "Wide", "Note.", {{"method"}, {"selection"}}, {}};
  for (int i = 0; i < 12; ++i)
    table.columns.push_back({"column " + std::to_string(i), Format::kError});
  for (int row = 0; row < 50; ++row) {
    table.rows.push_back({"m", "s" + std::to_string(row)});
    for (int i = 0; i < 12; ++i) table.rows.back().push_back(0.5);
  }
  const std::string latex = toLatex(table, "global");
  const auto count = [&latex](const std::string& text) {
    std::size_t found = 0;
    for (std::size_t at = latex.find(text); at != std::string::npos; at = latex.find(text, at + 1))
      ++found;
    return found;
  };
  EXPECT_EQ(count("\\begin{table}"), 6u);  // three parts of columns, each of two pages
  EXPECT_EQ(count("\\bottomrule"), 6u);
  EXPECT_EQ(count("m & s49 & "), 3u);
  for (const std::string label : {"wide}", "wide-2}", "wide-3}", "wide-4}", "wide-5}", "wide-6}"}) {
    EXPECT_EQ(count("\\label{tab:pcrb-global-" + label), 1u) << label;
  }
}

TEST(ReportTable, HasInLatexNoLetterThatItDoesNotKnow) {
  EXPECT_EQ(latexEscaped("5° ± 1 σ, 50 % of a_b"),
            "5$^\\circ$ $\\pm$ 1 $\\sigma$, 50 \\% of a\\_b");
  EXPECT_EQ(latexEscaped("café 中 \xff"), "café ? ?");
  EXPECT_EQ(latexEscaped(R"(x_1#${}~^\[*|)"), R"(x\_1\#\$\{\}\~{}\^{}\textbackslash{}{[}{*}$|$)");
  EXPECT_EQ(latexEscaped("Łódź ę ж\t\x01"), "Łódź e ? ?");
  EXPECT_EQ(latexEscaped("a_cd efghi", 3), "a\\_c\\hspace{0pt}d efg\\hspace{0pt}hi");
}

TEST(ReportTable, HasThreeSignificantDigitsAndNoZeroForWhatIsNone) {
  const auto text = [](double value) { return cellText(Json(value), Format::kError); };
  EXPECT_EQ(text(0.123456), "0.123");
  EXPECT_EQ(text(0.0099999), "0.0100");
  EXPECT_EQ(text(9.999), "10.0");
  EXPECT_EQ(text(12345.6), "12346");
  EXPECT_EQ(text(0.00001234), "1.23e-05");
  EXPECT_EQ(text(1.7e308), "1.70e+308");
  EXPECT_EQ(text(-0.02), "-0.0200");
  EXPECT_EQ(text(0.0), "0");
  EXPECT_EQ(cellText(Json(0.00004), Format::kFraction), "4.00e-05");
  EXPECT_EQ(cellText(Json(0.5), Format::kFraction), "0.500");
  EXPECT_EQ(cellText(Json(0.0123), Format::kSeconds), "0.0123");
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
