#include "conversion/conversion.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "pcrb_core/error.hpp"
#include "pcrb_core/io/pcd.hpp"
#include "support/expect_error.hpp"
#include "support/log_folder.hpp"
#include "support/temporary_folder.hpp"

namespace pcrb_tools {
namespace {

using Names = std::vector<std::string>;

ConvertedScan scanAt(double x) {
  ConvertedScan scan;
  scan.cloud.points = {{x, 2.0, 3.0}};
  scan.counts.read = 1;
  return scan;
}

class AConversion : public testing::Test {
 protected:
  AConversion() {
    request_.root = folder_.path();
    request_.data_set = "eth";
  }

  std::string file(const std::string& name) const { return folder_.file("eth/plain/" + name); }

  /// Converts scans by name, each to a cloud of one point at x.
  ConversionReport convert(const std::map<std::string, double>& scans) const {
    Conversion conversion(request_, "plain", scans.size());
    for (const auto& [name, x] : scans) announce(conversion, name, x);
    return conversion.finish();
  }

  static void announce(Conversion& conversion, const std::string& name, double x) {
    if (!conversion.wants(name, "at " + std::to_string(x))) return;
    conversion.add(name, [x = x] { return scanAt(x); });
  }

  double xOf(const std::string& name) const { return pcrb::readPcd(file(name)).points.at(0).x(); }

  pcrb_test::TemporaryFolder folder_;
  ConversionRequest request_;
};

TEST_F(AConversion, DropsAScanWithoutAValidPointAndWritesNothingForIt) {
  Conversion conversion(request_, "plain", 2);
  announce(conversion, "a.pcd", 1.0);
  ASSERT_TRUE(conversion.wants("b.pcd", ""));
  conversion.add("b.pcd", [] {
    ConvertedScan scan;
    scan.counts = {5, 5, 0, 0};
    return scan;
  });
  const ConversionReport report = conversion.finish();
  EXPECT_EQ(report.scans_read, 2u);
  EXPECT_EQ(report.written, std::set<std::string>{"a.pcd"});
  EXPECT_EQ(report.dropped.at("without a valid point"), Names{"b.pcd"});
  EXPECT_EQ(pcrb_test::namesIn(folder_.file("eth/plain")), (Names{".conversion", "a.pcd"}));
}

TEST_F(AConversion, RemovesWhatAnEarlierRunMadeAndItDoesNot) {
  convert({{"a.pcd", 1.0}, {"b.pcd", 2.0}, {"c.pcd", 3.0}});
  const ConversionReport report = convert({{"b.pcd", 2.0}});
  EXPECT_EQ(report.scans_kept, 1u);
  EXPECT_EQ(report.removed, (Names{"a.pcd", "c.pcd"}));
  EXPECT_NE(formatReport(report).find("removed, as this run does not make them: 2 clouds"),
            std::string::npos);
  EXPECT_EQ(pcrb_test::namesIn(folder_.file("eth/plain")), (Names{".conversion", "b.pcd"}));
}

TEST_F(AConversion, RemovesNothingThatItDidNotWriteItself) {
  convert({{"a.pcd", 1.0}, {"b.pcd", 2.0}});
  std::ofstream(file("a.pcd"), std::ios::app) << "4 5 6\n";
  pcrb_test::writeFile(file("mine.pcd"), "mine");
  const ConversionReport report = convert({{"b.pcd", 2.0}});
  EXPECT_EQ(report.removed, Names{});
  EXPECT_EQ(report.others, (Names{"a.pcd", "mine.pcd"}));
}

TEST_F(AConversion, RemovesNothingWhenItFails) {
  convert({{"a.pcd", 1.0}});
  {
    Conversion conversion(request_, "plain", 1);
    ASSERT_TRUE(conversion.wants("b.pcd", ""));
    conversion.add("b.pcd", []() -> ConvertedScan { throw pcrb::InvalidFile("log", "is broken"); });
    PCRB_EXPECT_ERROR(pcrb::InvalidFile, conversion.finish(), "is broken");
  }
  EXPECT_EQ(xOf("a.pcd"), 1.0);
}

TEST_F(AConversion, ThatIsLiveNeitherKeepsNorRemovesWhatAnEarlierRunMade) {
  convert({{"a.pcd", 1.0}, {"b.pcd", 2.0}});
  request_.live = true;
  request_.max_waiting = 1;
  const ConversionReport report = convert({{"a.pcd", 1.0}});
  EXPECT_EQ(report.scans_kept, 0u);
  EXPECT_EQ(report.others, Names{"b.pcd"});
  EXPECT_NE(formatReport(report).find("a live run, which may see a part of a log, removes none"),
            std::string::npos);
  EXPECT_EQ(xOf("b.pcd"), 2.0);
}

TEST_F(AConversion, ReplacesNoCloudThatNoConverterMadeUnlessForced) {
  pcrb_test::writeFile(file("a.pcd"), "published");
  PCRB_EXPECT_ERROR(pcrb::InvalidFile, convert({{"a.pcd", 1.0}}),
                    "eth/plain/a.pcd: is there and was not made by this tool");
  EXPECT_EQ(pcrb_test::readFile(file("a.pcd")), "published");
  request_.force = true;
  convert({{"a.pcd", 1.0}});
  EXPECT_EQ(xOf("a.pcd"), 1.0);
}

TEST_F(AConversion, ReplacesNoCloudThatWasChangedSinceUnlessForced) {
  convert({{"a.pcd", 1.0}});
  pcrb_test::writeFile(file("a.pcd"), "published");
  PCRB_EXPECT_ERROR(pcrb::InvalidFile, convert({{"a.pcd", 2.0}}),
                    "eth/plain/a.pcd: was changed since it was made");
  EXPECT_EQ(pcrb_test::readFile(file("a.pcd")), "published");
  request_.force = true;
  convert({{"a.pcd", 2.0}});
  EXPECT_EQ(xOf("a.pcd"), 2.0);
}

TEST_F(AConversion, ReplacesItsOwnCloudMadeFromSomethingElse) {
  convert({{"a.pcd", 1.0}});
  EXPECT_EQ(convert({{"a.pcd", 2.0}}).scans_kept, 0u);
  EXPECT_EQ(xOf("a.pcd"), 2.0);
}

TEST_F(AConversion, ReplacesACloudWhoseRecordAKillPrevented) {
  convert({{"a.pcd", 1.0}});
  pcrb_test::writeFile(file(".conversion"), "a.pcd\n");
  convert({{"a.pcd", 2.0}});
  EXPECT_EQ(xOf("a.pcd"), 2.0);
}

TEST_F(AConversion, CountsACloudThatWasTakenBackOnce) {
  convert({{"a.pcd", 1.0}});
  Conversion conversion(request_, "plain", 2);
  announce(conversion, "a.pcd", 1.0);
  PCRB_EXPECT_ERROR(pcrb::InvalidFile, conversion.wants("a.pcd", ""), "a second scan");
  conversion.retract("a.pcd");
  announce(conversion, "a.pcd", 2.0);
  conversion.retract("a.pcd");
  announce(conversion, "a.pcd", 3.0);
  const ConversionReport report = conversion.finish();
  EXPECT_EQ(report.written.size(), 1u);
  EXPECT_EQ(report.scans_kept, 0u);
  EXPECT_EQ(report.points.read, 1u);
  EXPECT_EQ(xOf("a.pcd"), 3.0);
}

}  // namespace
}  // namespace pcrb_tools
