#include <ros/package.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>

#include "benchmarking/batch_tool.hpp"
#include "pcrb_core/error.hpp"
#include "pcrb_core/io/atomic_file.hpp"
#include "pcrb_core/io/file_bytes.hpp"
#include "pcrb_core/io/number.hpp"
#include "pcrb_core/io/text.hpp"
#include "pcrb_core/run/results_store.hpp"

namespace pcrb_tools {
namespace {

namespace fs = std::filesystem;

constexpr const char* kShards = "shards ";

std::string noteFile(const BatchOptions& options) { return options.run + "/batch.txt"; }

std::vector<std::string> readLines(const std::string& path) {
  std::ifstream file(path);
  std::vector<std::string> lines;
  for (std::string line; std::getline(file, line);) lines.push_back(line);
  return lines;
}

/// An argument, and the hash of the file that it names, if any: shards that are complete are not
/// started again, so that nobody else would see that it was edited.
std::string withContent(const std::string& argument) {
  const std::string path = argument.substr(argument.find(":=") + 2);
  return fs::is_regular_file(path) ? argument + " " + pcrb::fileHash(path) : argument;
}

std::vector<std::string> configuration(const BatchOptions& options, int shards) {
  std::vector<std::string> lines{kShards + std::to_string(shards)};
  for (const auto& word : launchCommand(options)) {
    lines.push_back(word.find(":=") == std::string::npos ? word : withContent(word));
  }
  std::sort(lines.begin() + 2, lines.end());  // behind the number and `roslaunch`
  return lines;
}

std::string listLess(const std::vector<std::string>& list,
                     const std::vector<std::string>& without) {
  const std::set<std::string> known(without.begin(), without.end());
  std::string text;
  for (const auto& entry : list) {
    if (known.count(entry) == 0) text += " `" + entry + "`";
  }
  return text.empty() ? " nothing" : text;
}

bool isInPackage(const BatchOptions& options) {
  return options.launch.find('/') == std::string::npos;
}

std::string launchFile(const BatchOptions& options) {
  if (!isInPackage(options)) return fs::absolute(options.launch).lexically_normal().string();
  return ros::package::getPath("pcrb_launch") + "/" + options.launch;
}

std::string nameOf(const std::string& argument) { return argument.substr(0, argument.find(":=")); }

/// Nodes have another working directory. A library that is not there is looked for by the system.
std::string withAbsolutePath(const std::string& argument) {
  const std::string name = nameOf(argument);
  if (name != "root" && name != "parameters" && name != "plugin") return argument;
  const std::string path = argument.substr(std::min(argument.size(), name.size() + 2));
  if (name == "root" && !fs::is_directory(path)) {
    throw pcrb::InvalidParameter("root: found `" + path + "`, expected an existing folder");
  }
  if (path.empty() || (name == "plugin" && !fs::exists(path))) return argument;
  return name + ":=" + fs::absolute(path).lexically_normal().string();
}

/// Whether a problem of the batch has a result; also where that cannot be found out.
bool hasResults(const std::string& run) {
  std::vector<std::string> folders{run};
  if (fs::exists(run + "/shards")) {
    for (const auto& entry : fs::directory_iterator(run + "/shards")) {
      folders.push_back(entry.path().string());
    }
  }
  return std::any_of(folders.begin(), folders.end(), [](const std::string& folder) {
    if (!fs::exists(folder + "/results.sqlite")) return false;
    try {
      return pcrb::ResultsStore(folder, pcrb::ResultsStore::Access::kReadOnly).count() > 0;
    } catch (const pcrb::StoreError&) {
      return true;
    }
  });
}

}  // namespace

int numberOfShards(const BatchOptions& options) {
  if (options.shards > 0) return options.shards;
  const auto lines = readLines(noteFile(options));
  if (lines.empty()) return options.jobs;
  const bool is_number = pcrb::startsWith(lines.front(), kShards);
  const auto noted =
      is_number ? pcrb::parseInt(lines.front().substr(std::string(kShards).size())) : std::nullopt;
  if (!noted || *noted < 1) {
    throw pcrb::InvalidFile(noteFile(options), 1, "`" + lines.front() + "`", "`shards N`");
  }
  return static_cast<int>(*noted);
}

void noteConfiguration(const BatchOptions& options, int shards) {
  const auto asked = configuration(options, shards);
  const auto noted = readLines(noteFile(options));
  if (noted == asked) return;
  if (!noted.empty() && hasResults(options.run)) {
    throw pcrb::Error(noteFile(options) + ": the folder holds another batch: found" +
                      listLess(noted, asked) + ", asked for" + listLess(asked, noted) +
                      "; give another folder, or the arguments of this one");
  }
  std::string text;
  for (const auto& line : asked) text += line + "\n";
  pcrb::writeFileAtomically(noteFile(options), text);
}

void requireKnownArguments(const BatchOptions& options) {
  const std::string path = launchFile(options);
  std::string text;
  for (const auto& line : readLines(path)) text += line + "\n";
  if (text.empty()) throw pcrb::InvalidFile(path, 0, "no text", "a launch file");
  const std::regex declaration("<arg\\s[^>]*?\\bname\\s*=\\s*[\"']([^\"']+)[\"']");
  std::set<std::string> known;
  std::string list;
  for (std::sregex_iterator found(text.begin(), text.end(), declaration), end; found != end;
       ++found) {
    if (known.insert((*found)[1]).second) list += " " + (*found)[1].str();
  }
  for (const auto& argument : options.arguments) {
    if (known.count(nameOf(argument)) > 0) continue;
    throw pcrb::InvalidParameter("found `" + argument + "`, expected arguments of " + path + ":" +
                                 list);
  }
}

std::vector<std::string> launchCommand(const BatchOptions& options) {
  std::vector<std::string> command{"roslaunch"};
  if (isInPackage(options)) {
    command.insert(command.end(), {"pcrb_launch", options.launch});
  } else {
    command.push_back(launchFile(options));
  }
  for (const auto& argument : options.arguments) {
    const std::string name = nameOf(argument);
    if (name == "run" || name == "shard") {
      throw pcrb::InvalidParameter("found `" + argument + "`, expected no " + name +
                                   ":=, which this tool gives itself (see --help)");
    }
    command.push_back(withAbsolutePath(argument));
  }
  const char* const reason = "roslaunch takes no other bytes in a path";  // it writes them as XML
  for (const std::string& word : command) pcrb::requireUtf8(word, reason);
  pcrb::requireUtf8(options.run, reason);
  return command;
}

}  // namespace pcrb_tools
