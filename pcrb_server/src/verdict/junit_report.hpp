#pragma once

#include <string>
#include <utility>
#include <vector>

namespace pcrb {

/// One test of a JUnit file. It failed if it has a failure.
struct JunitCase {
  std::string name;
  std::vector<std::pair<std::string, std::string>> properties;
  std::string failure;
};

/// A JUnit file's one test suite.
struct JunitReport {
  std::string suite;
  std::vector<JunitCase> cases;
  std::string printed;   ///< becomes `system-out`
  double seconds = 0.0;  ///< that the suite took

  std::size_t failures() const;
};

/// The file's text, all that comes from others made printableText().
std::string toXml(const JunitReport& report);

}  // namespace pcrb
