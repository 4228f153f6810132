#include <gtest/gtest.h>
#include <tinyxml2.h>

#include <map>

#include "verdict/evaluation.hpp"

namespace pcrb {
namespace {

pcrb_msgs::Summary someSummary() {
  pcrb_msgs::Summary summary;
  summary.finished = 1;
  for (const char* name : {"hall", "total"}) {
    pcrb_msgs::SequenceSummary row;
    row.name = name;
    row.kind = "local";
    row.count = 4;
    row.replied = 3;
    row.timed_out = 1;
    row.median = 0.125;
    row.q95 = 0.5;
    summary.sequences.push_back(row);
  }
  return summary;
}

/// Name to value of the properties of a test case.
std::map<std::string, std::string> propertiesOf(const tinyxml2::XMLElement* test) {
  std::map<std::string, std::string> properties;
  const auto* list = test->FirstChildElement("properties");
  if (list == nullptr) return properties;
  for (const auto* property = list->FirstChildElement(); property != nullptr;
       property = property->NextSiblingElement()) {
    properties[property->Attribute("name")] = property->Attribute("value");
  }
  return properties;
}

TEST(Judge, GivesEveryNumberOfEveryRowAsAProperty) {
  Thresholds thresholds;
  thresholds.max_median = Threshold("max_median", {"0.2"}, 1e9);
  tinyxml2::XMLDocument document;
  ASSERT_EQ(document.Parse(toXml(judge(someSummary(), thresholds)).c_str()), tinyxml2::XML_SUCCESS);
  const auto* suite = document.RootElement();
  EXPECT_STREQ(suite->Attribute("tests"), "3");
  EXPECT_STREQ(suite->Attribute("failures"), "0");
  const auto* test = suite->FirstChildElement("testcase")->NextSiblingElement("testcase");
  EXPECT_STREQ(test->Attribute("name"), "hall local");
  const std::map<std::string, std::string> expected{
      {"count", "4"},       {"replied", "3"}, {"failed", "0"},     {"timed_out", "1"},
      {"rejected", "0"},    {"skipped", "0"}, {"median", "0.125"}, {"q75", "0"},
      {"q95", "0.5"},       {"mean", "0"},    {"stddev", "0"},     {"replied_fraction", "0.75"},
      {"max_median", "0.2"}};
  EXPECT_EQ(propertiesOf(test), expected);
}

TEST(Judge, PrintsTheTableAndEveryBreach) {
  Thresholds thresholds;
  thresholds.min_replied = Threshold("min_replied", {"hall=1"}, 1.0);
  const JunitReport report = judge(someSummary(), thresholds);
  EXPECT_EQ(report.failures(), 1U);
  EXPECT_NE(report.printed.find("0.1250"), std::string::npos);
  EXPECT_NE(
      report.printed.find("FAILED: hall local: replied fraction is 0.75, expected at least 1"),
      std::string::npos);
}

TEST(Judge, FailsForAThresholdOfAnUnknownSequence) {
  Thresholds thresholds;
  thresholds.max_q95 = Threshold("max_q95", {"atic=1"}, 1e9);
  const JunitReport report = judge(someSummary(), thresholds);
  EXPECT_EQ(report.failures(), 1U);
  EXPECT_NE(report.cases.front().failure.find("atic"), std::string::npos);
}

TEST(JunitReport, KeepsItsTextWhateverCharactersItHas) {
  JunitReport report = judgeUnfinished("a <b> & \"c\" \x01 \xe9 \xc3\xa9");
  report.printed = "]]> <end>";
  tinyxml2::XMLDocument document;
  ASSERT_EQ(document.Parse(toXml(report).c_str()), tinyxml2::XML_SUCCESS);
  const auto* suite = document.RootElement();
  const auto* failure = suite->FirstChildElement("testcase")->FirstChildElement("failure");
  EXPECT_STREQ(failure->GetText(), "a <b> & \"c\" \xef\xbf\xbd \xef\xbf\xbd \xc3\xa9");
  EXPECT_STREQ(suite->FirstChildElement("system-out")->GetText(), "]]> <end>");
}

}  // namespace
}  // namespace pcrb
