#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <set>
#include <string>

#include "pcrb_core/io/file_bytes.hpp"
#include "pcrb_core/io/number.hpp"
#include "report/table.hpp"
#include "support/report_fixture.hpp"

namespace pcrb_tools {
namespace {

/// Text of a result file of `plain` with ids like the published ones, each of a pair of its own.
template <typename ErrorOf>
std::string plainResults(std::size_t count, const ErrorOf& errorOf) {
  std::string text = "id,error,source,target\n";
  for (std::size_t i = 0; i < count; ++i) {
    const std::string number = std::to_string(1000 + i);
    text += "421552847" + number + "," + pcrb::formatShortest(errorOf(i)) + ",a" + number + ",b\n";
  }
  return text;
}

/// What compares methods with each other and with what is published.
class ReportComparisonTest : public ReportTest {
 protected:
  template <typename ErrorOf>
  void addImport(const std::string& method, std::size_t count, const ErrorOf& errorOf) {
    options_.imports.push_back(addFile(method + "_plain_local.csv", plainResults(count, errorOf)));
  }

  std::string page() {
    runReportTool(options_);
    return read(options_.output + "/index.html");
  }

  static bool has(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
  }
};

TEST_F(ReportComparisonTest, TakesTheDirectionFromTheRankSumsThatThePValueIsOf) {
  const auto base = [](std::size_t i) { return 2.0 + 0.001 * static_cast<double>(i); };
  addImport("precise", 100, [&](std::size_t i) {  // a little better 55 times, much worse 45 times
    return i < 55 ? base(i) - 0.01 : base(i) + 1.0 + static_cast<double>(i - 55) / 45.0;
  });
  addImport("robust", 100, base);
  const std::string text = page();
  const Rows rows = readCsv(options_.output + "/tables/local_comparisons.csv");
  EXPECT_EQ(rows[0].at("better"), "robust");
  EXPECT_EQ(rows[0].at("verdict"), "robust is better");
  EXPECT_GT(*pcrb::parseDouble(rows[0].at("difference")), 0.0);  // of precise minus robust
  EXPECT_TRUE(has(text, "robust is better than precise"));
}

TEST_F(ReportComparisonTest, MarksTheBestOnlyWhereAllMethodsHaveTheSameProblems) {
  addImport("full", 100, [](std::size_t i) { return i < 20 ? 0.1 : 5.0; });
  addImport("part", 20, [](std::size_t) { return 1.0; });
  std::string text = page();
  EXPECT_FALSE(has(text, "class=\"best\""));
  EXPECT_TRUE(
      has(text, "<th scope=\"row\" class=\"text\">plain<small>20 of 100 shared</small></th>"));
  EXPECT_TRUE(has(text, "The methods have different problems (20 of 100 shared)"));
  EXPECT_TRUE(has(text, "full is better than part"));
  EXPECT_TRUE(has(read(options_.output + "/report.md"), "all share 20 of 100 in plain"));

  options_.imports.clear();
  addImport("full", 20, [](std::size_t) { return 0.1; });
  addImport("part", 20, [](std::size_t) { return 1.0; });
  text = page();
  EXPECT_TRUE(has(text, "class=\"best\""));
  EXPECT_FALSE(has(text, "shared</small>"));
  EXPECT_FALSE(has(text, "different problems"));
}

TEST_F(ReportComparisonTest, PutsAllPublishedMethodsOfTheKindBesideAMethodOfTheUsersOwn) {
  addImport("mine", 20, [](std::size_t) { return 0.1; });
  addImport("ppcr", 20, [](std::size_t) { return 0.2; });
  const std::string text = page();
  EXPECT_TRUE(has(text,
                  "<th scope=\"col\">mine</th><th scope=\"col\">ppcr</th>"
                  "<th scope=\"col\">ppcr, published</th><th scope=\"col\">icp, published</th>"
                  "<th scope=\"col\">gicp, published</th>"
                  "<th scope=\"col\">ndt, published</th></tr>"));
  EXPECT_TRUE(has(text, "<td class=\"published\">0.17</td><td class=\"published\">0.40</td>"));
  EXPECT_TRUE(has(text, "ndt 0.87 against misalignment"));  // Table 8
  EXPECT_FALSE(has(text, "teaser, published"));
}

TEST_F(ReportComparisonTest, PutsNothingPublishedBesideOtherProblemsOrAnotherDataSet) {
  options_.imports = {addFile("mine_plain_local.csv", "id,error\n1,0.1\n2,0.2\n")};
  std::string text = page();
  EXPECT_FALSE(has(text, ", published</th>"));
  EXPECT_TRUE(has(text, "No published figures stand beside plain"));
  options_.imports = {
      addFile("mine_plain_local.csv", "id,error,data_set\n4215528471000,0.1,mine\n")};
  text = page();
  EXPECT_FALSE(has(text, ", published</th>"));
}

TEST_F(ReportComparisonTest,
       PutsNothingPublishedBesideProblemsWhoseSideFileNamesTheToolThatDrewThem) {
  namespace fs = std::filesystem;
  fs::create_directories(folder_.file("root/eth/plain"));
  const std::string file = "root/eth/plain_local.txt";
  addFile(file,
          "id source target overlap t1 t2 t3 t4 t5 t6 t7 t8 t9 t10 t11 t12\n"
          "4215528471000 a b 0.5 1 0 0 0 0 1 0 0 0 0 1 0\n");
  options_.root = folder_.file("root");
  options_.imports = {addFile("mine_plain_local.csv", "id,error\n4215528471000,0.1\n")};
  EXPECT_TRUE(has(page(), "<th scope=\"col\">icp, published</th>"));
  addFile(file + ".yaml",
          "tool: sample_problems\noutput_blake2b: " + pcrb::fileHash(folder_.file(file)) + "\n");
  EXPECT_FALSE(has(page(), ", published</th>"));
  options_.imports.clear();
  options_.runs = {addRun("older", 0.1)};  // than what a run table says of it
  options_.with_components = false;
  EXPECT_FALSE(has(page(), ", published</th>"));
}

TEST_F(ReportComparisonTest, DrawsIntervalsOverDecadesWhole) {
  addImport("torn", 11, [](std::size_t i) { return i < 6 ? 0.01 : 9.0; });
  EXPECT_TRUE(has(page(), "torn, plain: median 0.0100, 95 % interval 0.01 – 9.00"));
  EXPECT_FALSE(has(page(), "class=\"beyond\""));
}

TEST_F(ReportComparisonTest, GivesNoIntervalNoMarkAndNoVerdictForFewerPairsThanATestNeeds) {
  addImport("good", 5, [](std::size_t) { return 0.1; });
  addImport("bad", 5, [](std::size_t) { return 1.0; });
  std::string text = page();
  EXPECT_FALSE(has(text, "class=\"best\""));
  EXPECT_TRUE(has(text, "good and bad: too few pairs to tell"));
  EXPECT_TRUE(has(text, "good, plain: median 0.100, too few pairs for an interval"));
  EXPECT_TRUE(has(read(options_.output + "/report.md"), "too few pairs to tell"));
  EXPECT_EQ(readCsv(options_.output + "/tables/local_scores.csv")[0].at("low"), "");

  options_.imports.clear();
  addImport("good", 6, [](std::size_t) { return 0.1; });
  addImport("bad", 6, [](std::size_t) { return 1.0; });
  text = page();
  EXPECT_TRUE(has(text, "class=\"best\""));
  EXPECT_TRUE(has(text, "good is better than bad"));
  EXPECT_TRUE(has(read(options_.output + "/report.md"), "| plain | **0.100** | 1.00 |"));
  EXPECT_TRUE(has(read(options_.output + "/report.tex"), "plain & \\textbf{0.100} & 1.00"));
}

TEST_F(ReportComparisonTest, RanksThreeMethodsAndJoinsThoseThatNoTestTellsApart) {
  addImport("best", 20, [](std::size_t) { return 0.1; });
  addImport("worse", 20, [](std::size_t i) { return i % 2 == 0 ? 1.0 : 1.1; });
  addImport("like_it", 20, [](std::size_t i) { return i % 2 == 0 ? 1.1 : 1.0; });
  const std::string text = page();
  const Json ranking =
      Json::parse(read(options_.output + "/report.json"))["sections"][0]["charts"]["ranking"];
  EXPECT_EQ(ranking["pairs"], 20);
  EXPECT_EQ(ranking["methods"][0]["method"], "best");
  EXPECT_EQ(ranking["methods"][0]["rank"], 1.0);
  EXPECT_EQ(ranking["methods"][1]["rank"], 2.5);
  EXPECT_EQ(ranking["cliques"], Json::parse(R"([["worse", "like_it"]])"));
  EXPECT_TRUE(has(text, "no difference shown: worse, like_it"));
  EXPECT_TRUE(has(text, "all pairs of methods"));
}

TEST_F(ReportComparisonTest, NamesTheWorstProblemsOfARunWithTheCommandThatShowsEach) {
  options_.runs = {addRun("a run", 0.1)};
  const std::string text = page();
  const Json worst =
      Json::parse(read(options_.output + "/report.json"))["sections"][0]["worst"][0]["problems"];
  EXPECT_EQ(worst.size(), 10u);
  EXPECT_EQ(worst[0]["problem"], "4215528471039");
  EXPECT_EQ(worst[0]["command"],
            "pcrb replay --run '" + folder_.file("a run") +
                "' --sequences eth/plain --kind local --problem 4215528471039 --rviz");
  EXPECT_TRUE(has(text, "--problem 4215528471039 --rviz</code>"));
}

TEST_F(ReportComparisonTest, ShowsBesideTheMethodsWhatDoingNothingScores) {
  options_.runs = {addRun("good", 0.1), addRun("flaky", 0.2, 4)};
  const std::string text = page();
  EXPECT_TRUE(has(text,
                  "<th scope=\"col\">good</th><th scope=\"col\">flaky</th>"
                  "<th scope=\"col\">do nothing</th>"));
  EXPECT_TRUE(has(text, "<td class=\"untouched\">1.00</td>"));
  const Rows rows = readCsv(options_.output + "/tables/local_scores.csv");
  EXPECT_EQ(rows.back().at("method"), "do nothing");
  EXPECT_EQ(rows.back().at("median"), "1");
  EXPECT_EQ(rows.back().at("problems"), "40");
  EXPECT_EQ(rows.back().at("replied"), "");
}

TEST_F(ReportComparisonTest, TestsEachMethodAgainstDoingNothingInFamiliesOfTheirOwn) {
  options_.runs = {addRun("good", 0.1), addRun("bad", 3.0)};
  const std::string text = page();
  std::set<std::string> verdicts;
  double corrected = 0.0;
  for (auto& row : readCsv(options_.output + "/tables/local_comparisons.csv")) {
    verdicts.insert(row["a"] + " " + row["b"] + ": " + row["verdict"]);
    corrected = *pcrb::parseDouble(row["corrected p"]);
  }
  EXPECT_EQ(verdicts,
            (std::set<std::string>{"good bad: good is better", "good do nothing: good is better",
                                   "bad do nothing: do nothing is better"}));
  EXPECT_NEAR(corrected, 2 * 2 * std::pow(0.5, 20), 1e-12) << "of a family of two, 20 pairs";
  EXPECT_TRUE(has(text, "do nothing is better than bad"));
  options_.runs = {addRun("alone", 0.1)};
  EXPECT_TRUE(has(page(), "alone is better than do nothing"));
}

TEST_F(ReportComparisonTest, HasDoingNothingInEveryTableAndChartOfErrors) {
  options_.runs = {addRun("good", 0.1), addRun("fair", 0.2), addRun("flaky", 0.3, 40)};
  const std::string text = page();
  for (const std::string table : {"scores", "comparisons", "correlations", "recall"}) {
    EXPECT_TRUE(has(read(options_.output + "/tables/local_" + table + ".csv"), "do nothing"))
        << table;
  }
  const Json charts = Json::parse(read(options_.output + "/report.json"))["sections"][0]["charts"];
  for (const std::string chart : {"solved", "over_misalignment", "over_overlap", "histograms"}) {
    EXPECT_TRUE(has(charts[chart].dump(), "do nothing")) << chart;
  }
  EXPECT_EQ(charts["ranking"]["methods"][3]["method"], "do nothing");
  EXPECT_EQ(charts["ranking"]["methods"][3]["rank"], 3.5) << "flaky has no reply";
  EXPECT_TRUE(has(text, "data-method=\"do nothing\""));
}

}  // namespace
}  // namespace pcrb_tools
