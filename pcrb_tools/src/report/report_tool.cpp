#include "report/report_tool.hpp"

#include <ros/package.h>

#include <string>
#include <vector>

#include "common/run_child.hpp"
#include "pcrb_core/error.hpp"

namespace pcrb_tools {
namespace {

constexpr const char* kPython = PCRB_PYTHON;  // the interpreter that CMake found

}  // namespace

void runReportTool(const ReportOptions& options) {
  writeReportData(options);
  const std::string script = ros::package::getPath("pcrb_tools") + "/report/draw_report.py";
  std::vector<std::string> command{kPython, "-B", script, options.output};
  if (!options.draw_figures) command.emplace_back("--no-figures");
  const int status = runChild(command);
  if (status != 0) {
    throw pcrb::Error("drawing " + options.output + " failed with status " +
                      std::to_string(status) + " (see above); what was computed is there");
  }
}

}  // namespace pcrb_tools
