#include "common/tool_main.hpp"

#include <malloc.h>
#include <ros/init.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <iostream>
#include <limits>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "common/process.hpp"
#include "pcrb_core/io/memory_budget.hpp"
#include "pcrb_core/io/process_limits.hpp"
#include "pcrb_core/io/text.hpp"
#include "pcrb_core/parallel.hpp"
#include "pcrb_server/node_parameters.hpp"

namespace pcrb_tools {
namespace {

std::string toolName(int argc, char** argv) {
  return argc > 0 ? std::filesystem::path(argv[0]).filename().string() : std::string("pcrb_tool");
}

/// Has the next cloud take the memory of the last one. Where page faults are dear, to give pages
/// back and get them again, cleared, was up to half of a converter's time (docs/benchmarks.md).
void keepFreedMemory() {
  constexpr int kMost = 1 << 25;  // bytes; larger blocks are never kept
  mallopt(M_MMAP_THRESHOLD, kMost);
  mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max());
}

/// CLI11 wants the arguments without the program's name, last one first.
std::vector<std::string> argumentsForCli(int argc, char** argv) {
  std::vector<std::string> arguments;
  ros::removeROSArgs(argc, argv, arguments);
  if (!arguments.empty()) arguments.erase(arguments.begin());
  std::transform(arguments.begin(), arguments.end(), arguments.begin(), withHomeFolder);
  std::reverse(arguments.begin(), arguments.end());
  return arguments;
}

/// Of the tools that launch files wrap: roslaunch, which appends `__name:=…`, starts them in
/// another folder.
void requireAbsolutePaths(const CLI::App& app, int argc, char** argv) {
  const auto is_roslaunchs = [](const char* word) { return pcrb::startsWith(word, "__name:="); };
  if (std::none_of(argv, argv + argc, is_roslaunchs)) return;
  for (const std::string name : {"logs", "root", "run"}) {
    const CLI::Option* const option = app.get_option_no_throw("--" + name);
    if (option == nullptr || option->empty()) continue;
    const std::string mistake = pcrb::relativePathMistake(name, option->results().front());
    if (!mistake.empty()) throw CLI::ValidationError("--" + name, mistake);
  }
}

/// All options, for programs in front of this one: a line each, with tabs between long names, short
/// names, the name of its place, type and limits, default, 1 if it must be given, the largest
/// number of words that follow it, and the help.
int describeOptions(const CLI::App& app) {
  for (const CLI::Option* option : app.get_options()) {
    if (option == app.get_help_ptr()) continue;
    std::cout << pcrb::joined(option->get_lnames(), ",") << '\t'
              << pcrb::joined(option->get_snames(), ",") << '\t'
              << (option->get_positional() ? option->get_name(true) : "") << '\t'
              << option->get_type_name() << '\t' << option->get_default_str() << '\t'
              << option->get_required() << '\t' << option->get_items_expected_max() << '\t'
              << option->get_description() << '\n';
  }
  return kSuccess;
}

int complain(const std::string& tool, const std::exception& error, int status) {
  std::string what = pcrb::describeFailure(error);
  std::replace(what.begin(), what.end(), '\n', ' ');
  std::cerr << tool << ": " << what << std::endl;
  return status;
}

/// Every tool reads files of strangers.
void addMemoryOption(CLI::App& app) {
  constexpr double kMost = 1e9;  // MB
  const auto set = [](double megabytes) {
    pcrb::MemoryBudget::ofProcess().setLimit(static_cast<std::size_t>(megabytes * 1e6));
  };
  app.add_option_function<double>("--memory", set,
                                  "MB of memory that all threads together may take for clouds and "
                                  "scans that they read [a quarter of the machine's]")
      ->check(CLI::Range(1.0, kMost));
}

}  // namespace

std::string withHomeFolder(const std::string& word) {
  const char* const home = std::getenv("HOME");
  const std::size_t assigned = word.find("=~/");
  const bool is_value = assigned != std::string::npos && word.find('/') == assigned + 2;
  const std::size_t tilde = is_value ? assigned + 1 : 0;
  if (home == nullptr || word.compare(tilde, 2, "~/") != 0) return word;
  return word.substr(0, tilde) + home + word.substr(tilde + 1);
}

CLI::Option* addThreadsOption(CLI::App& app, int& threads) {
  constexpr int kMostThreads = 1024;
  threads = pcrb::processorCount();
  return app
      .add_option("--jobs,--threads", threads,
                  "number of threads, which does not change the result")
      ->check(CLI::Range(1, kMostThreads))
      ->capture_default_str();
}

CLI::Option* addSensorInBodyOption(CLI::App& app, std::optional<pcrb::Transform>& T_body_sensor,
                                   const std::string& otherwise) {
  const auto take = [&T_body_sensor](const std::vector<double>& n) {
    T_body_sensor =
        pcrb::makeTransform({n[0], n[1], n[2]}, Eigen::Quaterniond(n[6], n[3], n[4], n[5]));
  };
  return app
      .add_option_function<std::vector<double>>(
          "--sensor-in-body", take,
          "x y z qx qy qz qw of the sensor where poses are those of a body [" + otherwise + "]")
      ->expected(7);
}

CLI::Option* addPoseFormatOption(CLI::App& app, std::optional<pcrb::PoseFormat>& format) {
  std::map<std::string, pcrb::PoseFormat> formats;
  for (const auto known :
       {pcrb::PoseFormat::kTum, pcrb::PoseFormat::kKitti, pcrb::PoseFormat::kEuroc,
        pcrb::PoseFormat::kKaist, pcrb::PoseFormat::kLog, pcrb::PoseFormat::kCsv}) {
    formats[pcrb::toString(known)] = known;
  }
  return addChoice(app, "--pose-format", format, formats,
                   "format of a text of poses [by its first rows]");
}

bool isKept(const pcrb::DerivedFile& output, bool force) {
  if (output.isUpToDate()) {
    std::cerr << output.path() << ": complete and unchanged, kept" << std::endl;
    return true;
  }
  if (!force) output.requireReplaceable();
  return false;
}

int runTool(CLI::App& app, int argc, char** argv, const std::function<int()>& body) {
  const std::string tool = toolName(argc, argv);
  app.name(tool);
  pcrb::turnLimitsIntoErrors(tool);
  keepFreedMemory();
  addMemoryOption(app);
  if (argc == 2 && std::string_view(argv[1]) == "--describe") return describeOptions(app);
  try {
    app.parse(argumentsForCli(argc, argv));
    requireAbsolutePaths(app, argc, argv);
  } catch (const CLI::Success& help) {
    return app.exit(help);
  } catch (const CLI::ParseError& error) {
    return complain(tool, std::runtime_error(std::string(error.what()) + " (see --help)"),
                    kUsageError);
  }
  try {
    return body();
  } catch (const Interrupted& error) {
    return complain(tool, error, 128 + SIGINT);  // as a shell has it
  } catch (const std::exception& error) {
    return complain(tool, error, kFailure);
  }
}

}  // namespace pcrb_tools
