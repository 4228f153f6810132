#pragma once

#include <pcrb_msgs/Summary.h>

#include <string>
#include <utility>
#include <vector>

#include "pcrb_server/node_main.hpp"
#include "verdict/threshold.hpp"

namespace pcrb {

extern const ParameterTable kEvaluationParameters;

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

/// The verdict on a run: one test for the run itself and one per row of its summary, with every
/// number as a property; the table, and every breach of a threshold, as printed text.
JunitReport judge(const pcrb_msgs::Summary& summary, const Thresholds& thresholds);

/// The verdict on a run that has no summary.
JunitReport judgeUnfinished(const std::string& why);

/// Takes rostest's arguments (`--gtest_output=xml:FILE`, `--text`) out of the list.
/// @return  the file, or nothing.
std::string takeJunitFile(int& argc, char** argv);

/// Watches a run to its end, prints the verdict, and writes it to a JUnit file if there is one.
/// Reads the node's private parameters.
/// @return  exit status: 0 only if the run finished and every threshold was kept.
int runEvaluation(const std::string& junit_file, const ShutdownRequest& shutdown);

}  // namespace pcrb
