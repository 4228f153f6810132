#include <filesystem>
#include <set>
#include <string>

#include "support/report_fixture.hpp"

namespace pcrb_tools {
namespace {

namespace fs = std::filesystem;

using AuthorsResults = ReportTest;

TEST_F(AuthorsResults, ImportsTheResultFilesOfThePapersAuthors) {
  const std::string matrix = "1 0 0 0.5 0 1 0 0.25 0 0 1 -1e-3 0 0 0 1 ";
  const std::string header = "id;initial_error;final_error;transformation\n";
  fs::create_directories(folder_.file("FastGlobal"));
  addFile("FastGlobal/plain_global_result.txt",
          "# registration_from_features.py FastGlobal\n" + header + "4;7.9;0.5;" + matrix + "\n");
  options_.imports = {
      addFile("plain_local_result.txt", "#;prob_registration_l1 -r tester -m 10 \n" + header +
                                            "12;0.5;0.25;25;" + matrix + "\n13;0.5;0.75;" + matrix +
                                            "\r\n"),
      "mine=" + addFile("my_yard_local_result.txt", header + "14;0.1;0.2;" + matrix),
      folder_.file("FastGlobal/plain_global_result.txt")};
  writeReportData(options_);
  std::set<std::string> read;
  for (const std::string kind : {"local", "global"}) {
    for (auto& row : readCsv(options_.output + "/tables/" + kind + "_problems.csv")) {
      read.insert(row["method"] + " " + row["sequence"] + " " + row["problem"] + " " +
                  row["error"] + " " + row["misalignment"]);
    }
  }
  EXPECT_EQ(read, (std::set<std::string>{"ppcr plain 12 0.25 0.5", "ppcr plain 13 0.75 0.5",
                                         "mine my_yard 14 0.2 0.1", "FastGlobal plain 4 0.5 7.9"}));
}

TEST_F(AuthorsResults, ImportsWhatTheAuthorsAddedToTheirFormat) {
  const std::string matrix = "1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1";
  const std::string header = "id;initial_error;final_error;transformation;status_code\r\n";
  options_.imports = {
      "learned=" + addFile("plain_global_result.txt",
                           "# fmr_benchmark.py\r\n#-i 40\r\n" + header + "4;7.9;0.5;" + matrix +
                               ";ok\r\n5;3;3;" + matrix + ";OOM\r\n6;2;1.5;" + matrix + "; ok\r\n"),
      addFile("stairs_global_result.txt",
              "\xef\xbb\xbf\n #prob_registration_l1 -m 10\n id ; "
              "initial_error; final_error;flops;transformation \n\n"
              " 7 ; 0.5 ; 0.25;1e9 ; " +
                  matrix + " \n")};
  writeReportData(options_);
  std::set<std::string> read;
  for (auto& row : readCsv(options_.output + "/tables/global_problems.csv")) {
    read.insert(row["method"] + " " + row["problem"] + " " + row["outcome"] + " " + row["error"] +
                " " + row["misalignment"] + " " + row["reason"]);
  }
  EXPECT_EQ(read, (std::set<std::string>{"learned 4 replied 0.5 7.9 ", "learned 5 failed 3 3 OOM",
                                         "learned 6 replied 1.5 2 ", "ppcr 7 replied 0.25 0.5 "}));
}

TEST_F(AuthorsResults, RefusesFilesOfTheAuthorsWithADefectNamingFileAndLine) {
  const std::string header = "#;x\nid;initial_error;final_error;transformation\n";
  const auto expectRefusal = [&](const std::string& text, const std::string& message) {
    options_.imports = {addFile("plain_local_result.txt", text)};
    pcrb_test::expectError<pcrb::InvalidFile>([&] { writeReportData(options_); }, message);
  };
  expectRefusal(header, "found no row");
  expectRefusal("#;x\n1;2;3;4\n", ":2: found '1;2;3;4'");
  expectRefusal(header + "1;0.5;0.25\n", ":3: found 3 fields");
  expectRefusal(header + "1;0.5;-nan;1 0\n", ":3: found '-nan'");
  expectRefusal(header + "1;0.5;0.25;1 0 0 0 0 1\n", ":3: found a transformation of 6 numbers");
  expectRefusal(header + ";0.5;0.25;1 0\n", ":3: found an empty field");
  expectRefusal("id;initial_error;final_error\n", ":1: found 0 columns `transformation`");
  options_.imports = {addFile("plain.txt", header + "1;0.5;0.25;1 0\n")};
  pcrb_test::expectError<pcrb::InvalidFile>([&] { writeReportData(options_); },
                                            "<sequence>_local_result.txt");
}

}  // namespace
}  // namespace pcrb_tools
