#include "verdict/junit_report.hpp"

#include <tinyxml2.h>

#include <algorithm>

#include "pcrb_core/io/number.hpp"

namespace pcrb {

namespace {

/// XML 1.0 has no control characters but these three, not even escaped.
std::string printable(std::string text) {
  const auto is_forbidden = [](char c) {
    return static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\t' && c != '\r';
  };
  std::replace_if(text.begin(), text.end(), is_forbidden, '?');
  return text;
}

void addProperties(const JunitCase& test, tinyxml2::XMLElement& element) {
  if (test.properties.empty()) return;
  tinyxml2::XMLElement* list = element.InsertNewChildElement("properties");
  for (const auto& [name, value] : test.properties) {
    tinyxml2::XMLElement* property = list->InsertNewChildElement("property");
    property->SetAttribute("name", printable(name).c_str());
    property->SetAttribute("value", printable(value).c_str());
  }
}

void addCase(const JunitCase& test, const std::string& suite, tinyxml2::XMLElement& parent) {
  tinyxml2::XMLElement* element = parent.InsertNewChildElement("testcase");
  element->SetAttribute("name", printable(test.name).c_str());
  element->SetAttribute("classname", printable(suite).c_str());
  element->SetAttribute("time", "0");
  addProperties(test, *element);
  if (test.failure.empty()) return;
  const std::string failure = printable(test.failure);
  tinyxml2::XMLElement* mark = element->InsertNewChildElement("failure");
  mark->SetAttribute("type", "failure");
  mark->SetAttribute("message", failure.c_str());
  mark->SetText(failure.c_str());
}

}  // namespace

std::size_t JunitReport::failures() const {
  return static_cast<std::size_t>(std::count_if(
      cases.begin(), cases.end(), [](const JunitCase& test) { return !test.failure.empty(); }));
}

std::string toXml(const JunitReport& report) {
  tinyxml2::XMLDocument document;
  document.InsertEndChild(document.NewDeclaration());
  tinyxml2::XMLElement* suite = document.NewElement("testsuite");
  document.InsertEndChild(suite);
  suite->SetAttribute("name", printable(report.suite).c_str());
  suite->SetAttribute("tests", std::to_string(report.cases.size()).c_str());
  suite->SetAttribute("failures", std::to_string(report.failures()).c_str());
  suite->SetAttribute("errors", "0");
  suite->SetAttribute("time", formatFixed(report.seconds, 3).c_str());
  for (const auto& test : report.cases) addCase(test, report.suite, *suite);
  suite->InsertNewChildElement("system-out")->SetText(printable(report.printed).c_str());
  tinyxml2::XMLPrinter printer;
  document.Print(&printer);
  return printer.CStr();
}

}  // namespace pcrb
