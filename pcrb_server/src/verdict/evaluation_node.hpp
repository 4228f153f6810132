#pragma once

#include <string>

#include "pcrb_server/node_main.hpp"

namespace pcrb {

/// Takes rostest's arguments (`--gtest_output=xml:FILE`, `--text`) out of the list.
/// @return  the file, or nothing.
std::string takeJunitFile(int& argc, char** argv);

/// Watches a run to its end, prints the verdict, and writes it to a JUnit file if there is one.
/// Reads the node's private parameters.
/// @return  exit status: 0 only if the run finished and every threshold was kept.
int runEvaluation(const std::string& junit_file, const ShutdownNotice& shutdown);

}  // namespace pcrb
