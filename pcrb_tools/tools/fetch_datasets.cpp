#include <ros/package.h>

#include <iostream>

#include "common/tool_main.hpp"
#include "fetch/fetch_tool.hpp"
#include "preparation/preparation_tools.hpp"

namespace pcrb_tools::fetch_datasets {
namespace {

void addOptions(CLI::App& app, FetchOptions& options, bool& fetch_only) {
  app.add_option(
      "sequences", options.sequences,
      "sequences to fetch: names of sequences, data sets, or <data set>/<sequence> [all]");
  app.add_option("--logs", options.logs, "folder for what is downloaded")->required();
  app.add_option("--root", options.root, "root of the common layout")->required();
  app.add_option("--from", options.from, "folder of files that you have, which are not downloaded");
  app.add_flag_function(
      "--original", [&options](auto) { options.set = SourceSet::kOriginal; },
      "fetch the original logs, to make problems of one's own, instead of the published files");
  app.add_flag("--dry-run", options.dry_run, "say what would be done, and do nothing");
  app.add_flag("--force", options.force,
               "replace clouds and problem files below ROOT that are not the published ones");
  app.add_flag("--fetch-only", fetch_only, "neither convert nor check what was fetched");
  addThreadsOption(app, options.threads);
  app.add_option("--sources", options.sources,
                 "file that lists the sources [config/datasets.yaml]");
  app.add_option("--attempts", options.policy.attempts,
                 "attempts at a file, in a row and without progress")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
}

}  // namespace

int run(int argc, char** argv) {
  CLI::App app(
      "Downloads the four data sets of the benchmark with the published problem files, verifies "
      "them "
      "and puts them into the common layout.");
  app.footer(
      "Interrupted downloads go on where they stopped. SHA-256 sums are recorded in "
      "LOGS/SHA256SUMS "
      "when a file is seen first, and verified later.\n"
      "KAIST's original logs need a registration: --dry-run says what to download and where to put "
      "it.\n"
      "Example: fetch_datasets --logs ~/logs --root ~/benchmark eth/plain tum");
  FetchOptions options;
  bool fetch_only = false;
  addOptions(app, options, fetch_only);
  return runTool(app, argc, argv, [&] {
    if (options.sources.empty()) {
      options.sources = ros::package::getPath("pcrb_tools") + "/config/datasets.yaml";
    }
    options.prepare = !fetch_only;
    options.convert = [&](const auto& log) { return runConverter(log, options); };
    options.check = [&](const std::vector<std::string>& sequences, std::ostream& out) {
      CheckOptions check;
      check.root = options.root;
      check.sequences = sequences;
      check.threads = options.threads;
      return runCheckTool(check, out);
    };
    return runFetchTool(options, std::cout) ? kSuccess : kFailure;
  });
}

}  // namespace pcrb_tools::fetch_datasets
