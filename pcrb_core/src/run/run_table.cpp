#include "run/run_table.hpp"

#include <algorithm>
#include <iterator>
#include <sstream>

#include "pcrb_core/error.hpp"
#include "pcrb_core/io/number.hpp"

namespace pcrb {

namespace {

using RunText = std::optional<std::string>;

[[noreturn]] void refuseRunText(const std::string& text, const std::string& expected) {
  throw InvalidParameter("found `" + text + "`, expected " + expected);
}

std::string formatRunFlag(bool value) { return value ? "true" : "false"; }

bool parseRunFlag(const std::string& text) {
  if (text != "true" && text != "false") refuseRunText(text, "true or false");
  return text == "true";
}

std::uint64_t parseRunCount(const std::string& text) {
  const auto count = parseUnsigned(text);
  if (!count) refuseRunText(text, "a whole number");
  return *count;
}

double parseRunReal(const std::string& text) {
  const auto number = parseDouble(text);
  if (!number) refuseRunText(text, "a number");
  return *number;
}

std::vector<std::string> splitRunWords(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

template <typename List, typename Format>
std::string joinRunWords(const List& list, const Format& format) {
  std::string text;
  for (const auto& word : list) text += (text.empty() ? "" : " ") + std::string(format(word));
  return text;
}

RunText runTextUnlessEmpty(const std::string& text) {
  return text.empty() ? std::nullopt : RunText(text);
}

Handshake parseRunHandshake(const std::string& text) {
  if (text != "ready" && text != "none") refuseRunText(text, "ready or none");
  return text == "ready" ? Handshake::kReady : Handshake::kNone;
}

std::vector<Kind> parseRunKinds(const std::string& text) {
  std::vector<Kind> kinds;
  for (const std::string& word : splitRunWords(text)) kinds.push_back(kindFromString(word));
  return kinds;
}

const RunTableRow kRunTableRows[] = {
    {"under_test", RunKeyRole::kConfiguration, false,
     [](const RunInfo& i) { return RunText(i.configuration.under_test); },
     [](RunInfo& i, const std::string& text) { i.configuration.under_test = text; }},
    {"sequences", RunKeyRole::kConfiguration, true,
     [](const RunInfo& i) {
       return RunText(joinRunWords(i.configuration.selection.sequences,
                                   [](const std::string& word) { return word; }));
     },
     [](RunInfo& i, const std::string& text) {
       i.configuration.selection.sequences = splitRunWords(text);
     }},
    {"kinds", RunKeyRole::kConfiguration, false,
     [](const RunInfo& i) {
       return RunText(
           joinRunWords(i.configuration.selection.kinds, [](Kind kind) { return toString(kind); }));
     },
     [](RunInfo& i, const std::string& text) {
       i.configuration.selection.kinds = parseRunKinds(text);
     }},
    {"subset", RunKeyRole::kConfiguration, true,
     [](const RunInfo& i) { return RunText(std::to_string(i.configuration.selection.subset)); },
     [](RunInfo& i, const std::string& text) {
       i.configuration.selection.subset = parseRunCount(text);
     }},
    {"seed", RunKeyRole::kConfiguration, true,
     [](const RunInfo& i) { return RunText(std::to_string(i.configuration.selection.seed)); },
     [](RunInfo& i, const std::string& text) {
       i.configuration.selection.seed = parseRunCount(text);
     }},
    {"shard", RunKeyRole::kShard, true,
     [](const RunInfo& i) { return RunText(toString(i.configuration.selection.shard)); },
     [](RunInfo& i, const std::string& text) {
       i.configuration.selection.shard = shardFromString(text);
     }},
    {"root", RunKeyRole::kOwn, false,
     [](const RunInfo& i) { return runTextUnlessEmpty(i.configuration.selection.root); },
     [](RunInfo& i, const std::string& text) { i.configuration.selection.root = text; }},
    {"presentation", RunKeyRole::kConfiguration, true,
     [](const RunInfo& i) { return RunText(toString(i.configuration.presentation.kind)); },
     [](RunInfo& i, const std::string& text) {
       i.configuration.presentation.kind = presentationFromString(text);
     }},
    {"upright", RunKeyRole::kConfiguration, true,  // what yaw_only was called first
     [](const RunInfo& i) { return RunText(formatRunFlag(i.configuration.presentation.yaw_only)); },
     [](RunInfo& i, const std::string& text) {
       i.configuration.presentation.yaw_only = parseRunFlag(text);
     }},
    {"audit", RunKeyRole::kConfiguration, true,  // runs without it were made before there was one
     [](const RunInfo& i) {
       return i.configuration.presentation.audit ? RunText("true") : std::nullopt;
     },
     [](RunInfo& i, const std::string& text) {
       i.configuration.presentation.audit = parseRunFlag(text);
     }},
    {"results", RunKeyRole::kConfiguration, true,
     [](const RunInfo& i) {
       return i.configuration.results == ResultsTime::kLive ? RunText("live") : std::nullopt;
     },
     [](RunInfo& i, const std::string& text) {
       if (text != "live") refuseRunText(text, "live");
       i.configuration.results = ResultsTime::kLive;
     }},
    {"foreign_replies", RunKeyRole::kOwn, true,
     [](const RunInfo& i) {
       return i.foreign_replies > 0 ? RunText(std::to_string(i.foreign_replies)) : std::nullopt;
     },
     [](RunInfo& i, const std::string& text) { i.foreign_replies = parseRunCount(text); }},
    {"time_limit", RunKeyRole::kConfiguration, true,
     [](const RunInfo& i) { return RunText(formatShortest(i.configuration.time_limit)); },
     [](RunInfo& i, const std::string& text) { i.configuration.time_limit = parseRunReal(text); }},
    {"handshake", RunKeyRole::kConfiguration, false,
     [](const RunInfo& i) {
       return RunText(i.configuration.handshake == Handshake::kReady ? "ready" : "none");
     },
     [](RunInfo& i, const std::string& text) {
       i.configuration.handshake = parseRunHandshake(text);
     }},
    {"global_guess", RunKeyRole::kConfiguration, true,
     [](const RunInfo& i) { return RunText(formatRunFlag(i.configuration.global_guess)); },
     [](RunInfo& i, const std::string& text) {
       i.configuration.global_guess = parseRunFlag(text);
     }},
    {"debug", RunKeyRole::kConfiguration, true,
     [](const RunInfo& i) { return RunText(formatRunFlag(i.configuration.debug)); },
     [](RunInfo& i, const std::string& text) { i.configuration.debug = parseRunFlag(text); }},
    {"metric_version", RunKeyRole::kConfiguration, true,
     [](const RunInfo& i) { return RunText(i.metric_version); },
     [](RunInfo& i, const std::string& text) { i.metric_version = text; }},
    {"code_version", RunKeyRole::kRecorded, true,
     [](const RunInfo& i) { return runTextUnlessEmpty(i.code_version); },
     [](RunInfo& i, const std::string& text) { i.code_version = text; }},
    {"secret", RunKeyRole::kOwn, false,
     [](const RunInfo& i) { return i.secret ? RunText(i.secret->toHex()) : std::nullopt; },
     [](RunInfo& i, const std::string& text) { i.secret = Secret::fromHex(text); }},
    {"created", RunKeyRole::kOwn, false,
     [](const RunInfo& i) {
       return i.created ? RunText(formatShortest(*i.created)) : std::nullopt;
     },
     [](RunInfo& i, const std::string& text) { i.created = parseRunReal(text); }},
    {"problems", RunKeyRole::kOwn, false,
     [](const RunInfo& i) {
       return i.problems ? RunText(std::to_string(*i.problems)) : std::nullopt;
     },
     [](RunInfo& i, const std::string& text) { i.problems = parseRunCount(text); }},
    {"client", RunKeyRole::kClient, false, [](const RunInfo& i) { return i.client; },
     [](RunInfo& i, const std::string& text) { i.client = text; }},
    {"client_parameters", RunKeyRole::kClient, false,
     [](const RunInfo& i) { return i.client_parameters; },
     [](RunInfo& i, const std::string& text) { i.client_parameters = text; }},
    {"node_cpu_time_s", RunKeyRole::kOwn, false,
     [](const RunInfo& i) {
       return i.node_cpu_time > 0.0 ? RunText(formatShortest(i.node_cpu_time)) : std::nullopt;
     },
     [](RunInfo& i, const std::string& text) { i.node_cpu_time = parseRunReal(text); }},
    {"node_peak_memory_bytes", RunKeyRole::kOwn, false,
     [](const RunInfo& i) {
       return i.node_peak_memory > 0 ? RunText(std::to_string(i.node_peak_memory)) : std::nullopt;
     },
     [](RunInfo& i, const std::string& text) { i.node_peak_memory = parseRunCount(text); }},
    {"merged_from", RunKeyRole::kRecorded, false,
     [](const RunInfo& i) { return runTextUnlessEmpty(i.merged_from); },
     [](RunInfo& i, const std::string& text) { i.merged_from = text; }},
};

}  // namespace

const std::vector<RunTableRow>& runTableRows() {
  static const std::vector<RunTableRow> rows(std::begin(kRunTableRows), std::end(kRunTableRows));
  return rows;
}

const std::vector<NamedRunTableRows>& namedRunTableRows() {
  static const std::vector<NamedRunTableRows> rows = {
      {"problem_file ", RunKeyRole::kConfiguration, &RunInfo::problem_files},
      {"drawn_by ", RunKeyRole::kRecorded, &RunInfo::drawn_by},
      {"voxel_leaf ", RunKeyRole::kConfiguration, &RunInfo::voxel_leaves,
       true},                                                     // none in old runs
      {"cloud ", RunKeyRole::kRecorded, &RunInfo::clouds, true},  // of those used so far
      {"secret ", RunKeyRole::kOwn, &RunInfo::shard_secrets, true,
       [](const std::string& text) { Secret::fromHex(text); }}};
  return rows;
}

const RunTableRow* findRunTableRow(const std::string& key) {
  const auto& rows = runTableRows();
  const auto row =
      std::find_if(rows.begin(), rows.end(), [&](const auto& known) { return known.key == key; });
  return row == rows.end() ? nullptr : &*row;
}

const NamedRunTableRows* findNamedRunTableRows(const std::string& key) {
  const auto& list = namedRunTableRows();
  const auto rows = std::find_if(
      list.begin(), list.end(), [&](const auto& known) { return key.rfind(known.prefix, 0) == 0; });
  return rows == list.end() ? nullptr : &*rows;
}

}  // namespace pcrb
