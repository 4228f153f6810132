#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <regex>
#include <string>

#include "pcrb_core/run/results_store.hpp"
#include "report/latex.hpp"
#include "support/report_fixture.hpp"

namespace pcrb_tools {
namespace {

namespace fs = std::filesystem;

constexpr const char* kLongName = "sixty_letters_without_a_blank_as_a_method_with_its_version_has";

/// Standard output of a command.
std::string outputOf(const std::string& command) {
  std::string output;
  FILE* pipe = popen(command.c_str(), "r");
  std::array<char, 4096> buffer{};
  while (const std::size_t size = fread(buffer.data(), 1, buffer.size(), pipe)) {
    output.append(buffer.data(), size);
  }
  EXPECT_EQ(pclose(pipe), 0) << command;
  return output;
}

TEST_F(ReportTest, PageIsOneFileThatAsksForNothingElse) {
  options_.runs = {addRun("good", 0.1), addRun("bad", 0.2)};
  options_.title = "A & B <tested>";
  runReportTool(options_);
  const std::string page = read(options_.output + "/index.html");
  for (const std::string reference : {"src=", "@import", "url(", "http:", "https:", "fetch("}) {
    EXPECT_EQ(page.find(reference), std::string::npos) << reference;
  }
  EXPECT_NE(page.find("<h1>A &amp; B &lt;tested&gt;</h1>"), std::string::npos);
  EXPECT_NE(page.find("name=\"viewport\""), std::string::npos);
}

TEST_F(ReportTest, PublishedFiguresStandOnlyBesideProblemsThatNoToolDrew) {
  options_.runs = {"gicp=" + addRun("run", 0.1)};
  runReportTool(options_);
  EXPECT_NE(read(options_.output + "/index.html").find("<th scope=\"col\">gicp, published</th>"),
            std::string::npos);

  pcrb::ResultsStore(folder_.file("run"), pcrb::ResultsStore::Access::kReadWrite)
      .updateRunInfo("drawn_by eth/plain_local.txt", "sample_problems");
  runReportTool(options_);
  const std::string page = read(options_.output + "/index.html");
  EXPECT_EQ(page.find("<th scope=\"col\">gicp, published</th>"), std::string::npos);
  EXPECT_NE(page.find("No published figures stand beside plain"), std::string::npos);
  EXPECT_NE(read(options_.output + "/report.md").find("other ones than the published ones"),
            std::string::npos);
}

TEST(ReportFigures, HaveTheirCaptionsByTheRulesOfTheTables) {
  const Json rules = latexRules();
  const std::string text = "a_long_word_of_café_中 \x7f Łódź ę ž\u017f 5° of 50 %  twice~";
  const std::string folder = std::string(PCRB_TOOLS_FOLDER) + "/report";
  const std::string program =
      "import json, sys; sys.path.insert(0, sys.argv[1]); import figures; "
      "print(figures.latex(sys.argv[3], json.loads(sys.argv[2])), end=\"\")";
  EXPECT_EQ(outputOf(std::string(PCRB_PYTHON) + " -c '" + program + "' '" + folder + "' '" +
                     rules.dump() + "' '" + text + "'"),
            latexEscaped(text, rules.at("unbroken")));
}

TEST_F(ReportTest, ItsTablesAndFiguresCompileInLatex) {
  if (!fs::exists("/usr/bin/pdflatex")) GTEST_SKIP() << "pdflatex is not installed";
  options_.draw_figures = true;
  options_.runs = {addRun("good_one", 0.1), addRun("bad", 0.2, 5), addRun("ugly & 100 %", 0.3)};
  for (const char* name : {R"([x] *1*#${}~^\y| "q" <t> ąж)", "good one", kLongName}) {
    options_.runs.push_back(addRun(name, 0.4));
  }
  runReportTool(options_);
  std::ofstream(options_.output + "/paper.tex")
      << "\\documentclass{article}\n\\usepackage{booktabs,graphicx}\n\\begin{document}\n"
         "\\input{report}\\input{figures}\\end{document}\n";
  const std::string log = outputOf(
      "cd " + options_.output + " && pdflatex -interaction=nonstopmode -halt-on-error paper 2>&1");
  EXPECT_NE(log.find("Output written on paper.pdf"), std::string::npos) << log;
  EXPECT_EQ(log.find("multiply defined"), std::string::npos) << log;
  for (const char* name : {"good_one", "good_one_2"}) {  // of `good_one` and `good one`
    EXPECT_TRUE(fs::exists(options_.output + "/figures/local_histograms_" + name + ".pdf")) << name;
  }
  const std::regex overfull("Overfull .hbox .([0-9.]+)pt");
  for (std::sregex_iterator found(log.begin(), log.end(), overfull), end; found != end; ++found) {
    EXPECT_LT(std::stod((*found)[1]), 10.0) << found->str();  // pt beyond the page's width
  }
}

/// A page that holds another one in a frame as wide as a phone, and says how wide that has become.
std::string onAPhone(std::string page) {
  for (const auto& [letter, escaped] : {std::pair{"&", "&amp;"}, std::pair{"\"", "&quot;"}}) {
    page = std::regex_replace(page, std::regex(letter), escaped);
  }
  return "<body><iframe id=\"f\" width=\"390\" height=\"800\" srcdoc=\"" + page +
         "\"></iframe><script>onload = function () { document.body.dataset.width = "
         "document.getElementById('f').contentDocument.documentElement.scrollWidth; };</script>";
}

TEST_F(ReportTest, PageFitsAPhoneWhateverTheNamesOfMethods) {
  if (!fs::exists("/usr/bin/chromium")) GTEST_SKIP() << "chromium is not installed";
  options_.runs = {
      addRun("good", 0.1), addRun(kLongName, 0.2),
      addRun("sixty letters with \"quotes\", an <i>element</i> & 'blanks' in it", 0.3)};
  runReportTool(options_);
  std::ofstream(folder_.file("phone.html")) << onAPhone(read(options_.output + "/index.html"));
  const std::string page = outputOf(
      "/usr/bin/chromium --headless --no-sandbox --disable-gpu --dump-dom --user-data-dir=" +
      folder_.file("profile") + " file://" + folder_.file("phone.html") + " 2>/dev/null");
  std::smatch width;
  ASSERT_TRUE(std::regex_search(page, width, std::regex("data-width=\"(\\d+)\""))) << page;
  EXPECT_LE(std::stoi(width[1]), 390);  // less where a bar to scroll takes some
}

TEST_F(ReportTest, PageOpensInABrowserAndShowsItsNumbersOnHover) {
  if (!fs::exists("/usr/bin/chromium")) GTEST_SKIP() << "chromium is not installed";
  options_.runs = {addRun("good", 0.1), addRun("bad", 0.2, 5)};
  runReportTool(options_);
  const std::string log = folder_.file("browser.log");
  const std::string page = outputOf(
      "/usr/bin/chromium --headless --no-sandbox --disable-gpu --dump-dom --enable-logging=stderr "
      "--window-size=390,800 --user-data-dir=" +
      folder_.file("profile") + " file://" + options_.output + "/index.html 2>" + log);
  EXPECT_NE(page.find("data-tip=\"good, plain: median 0.10"), std::string::npos);
  for (const std::string made :
       {"<button type=\"button\">error</button>", "<button type=\"button\" title",
        "aria-pressed=\"true\"", "class=\"filter\"", "class=\"copy\"",
        "<title>good, plain: median 0.10"}) {
    EXPECT_NE(page.find(made), std::string::npos) << made;
  }
  EXPECT_EQ(read(log).find("CONSOLE"), std::string::npos) << read(log);
}

}  // namespace
}  // namespace pcrb_tools
