#include <tinyxml2.h>

#include <algorithm>

#include "pcrb_core/io/number.hpp"
#include "pcrb_core/io/text.hpp"
#include "verdict/evaluation.hpp"

namespace pcrb {

namespace {

/// Appends an element and returns it.
tinyxml2::XMLElement* addElement(tinyxml2::XMLElement& parent, const char* name) {
  return parent.InsertEndChild(parent.GetDocument()->NewElement(name))->ToElement();
}

void addProperties(const JunitCase& test, tinyxml2::XMLElement& element) {
  if (test.properties.empty()) return;
  tinyxml2::XMLElement* list = addElement(element, "properties");
  for (const auto& [name, value] : test.properties) {
    tinyxml2::XMLElement* property = addElement(*list, "property");
    property->SetAttribute("name", printableText(name).c_str());
    property->SetAttribute("value", printableText(value).c_str());
  }
}

void addCase(const JunitCase& test, const std::string& suite, tinyxml2::XMLElement& parent) {
  tinyxml2::XMLElement* element = addElement(parent, "testcase");
  element->SetAttribute("name", printableText(test.name).c_str());
  element->SetAttribute("classname", printableText(suite).c_str());
  element->SetAttribute("time", "0");
  addProperties(test, *element);
  if (test.failure.empty()) return;
  const std::string failure = printableText(test.failure);
  tinyxml2::XMLElement* mark = addElement(*element, "failure");
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
  suite->SetAttribute("name", printableText(report.suite).c_str());
  suite->SetAttribute("tests", std::to_string(report.cases.size()).c_str());
  suite->SetAttribute("failures", std::to_string(report.failures()).c_str());
  suite->SetAttribute("errors", "0");
  suite->SetAttribute("time", formatFixed(report.seconds, 3).c_str());
  for (const auto& test : report.cases) addCase(test, report.suite, *suite);
  addElement(*suite, "system-out")->SetText(printableText(report.printed).c_str());
  tinyxml2::XMLPrinter printer;
  document.Print(&printer);
  return printer.CStr();
}

}  // namespace pcrb
