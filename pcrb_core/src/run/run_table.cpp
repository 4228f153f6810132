#include "run/run_table.hpp"

#include <algorithm>

#include "pcrb_core/error.hpp"
#include "pcrb_core/io/number.hpp"
#include "pcrb_core/io/text.hpp"

namespace pcrb {

namespace {

using RunText = std::optional<std::string>;

[[noreturn]] void refuseRunText(const std::string& text, const std::string& expected) {
  throw InvalidParameter("found `" + text + "`, expected " + expected);
}

// What the table says of a value of each type, and a value of what it says.

RunText runText(const std::string& value) { return value; }
void readRunText(const std::string& text, std::string& value) { value = text; }

RunText runText(bool value) { return value ? "true" : "false"; }
void readRunText(const std::string& text, bool& value) {
  if (text != "true" && text != "false") refuseRunText(text, "true or false");
  value = text == "true";
}

RunText runText(std::uint64_t value) { return std::to_string(value); }
void readRunText(const std::string& text, std::uint64_t& value) {
  const auto count = parseUnsigned(text);
  if (!count) refuseRunText(text, "a whole number");
  value = *count;
}

RunText runText(double value) { return formatShortest(value); }
void readRunText(const std::string& text, double& value) {
  const auto number = parseDouble(text);
  if (!number) refuseRunText(text, "a number");
  value = *number;
}

RunText runText(const std::vector<std::string>& words) { return joined(words, " "); }
void readRunText(const std::string& text, std::vector<std::string>& words) {
  words = splitAtBlanks(text);
}

RunText runText(const std::vector<Kind>& kinds) {
  std::vector<std::string> words;
  for (const Kind kind : kinds) words.emplace_back(toString(kind));
  return runText(words);
}
void readRunText(const std::string& text, std::vector<Kind>& kinds) {
  std::vector<std::string> words;
  readRunText(text, words);
  kinds.clear();
  for (const std::string& word : words) kinds.push_back(kindFromString(word));
}

RunText runText(const ShardNumber& shard) { return toString(shard); }
void readRunText(const std::string& text, ShardNumber& shard) { shard = shardFromString(text); }

RunText runText(PresentationKind kind) { return toString(kind); }
void readRunText(const std::string& text, PresentationKind& kind) {
  kind = presentationFromString(text);
}

RunText runText(ResultsTime time) { return time == ResultsTime::kLive ? "live" : "end"; }
void readRunText(const std::string& text, ResultsTime& time) {
  if (text != "live") refuseRunText(text, "live");  // the other one is not written
  time = ResultsTime::kLive;
}

RunText runText(Handshake handshake) { return handshake == Handshake::kReady ? "ready" : "none"; }
void readRunText(const std::string& text, Handshake& handshake) {
  if (text != "ready" && text != "none") refuseRunText(text, "ready or none");
  handshake = text == "ready" ? Handshake::kReady : Handshake::kNone;
}

RunText runText(const Secret& secret) { return secret.toHex(); }
void readRunText(const std::string& text, std::optional<Secret>& secret) {
  secret = Secret::fromHex(text);
}

template <typename T>
RunText runText(const std::optional<T>& value) {
  return value ? runText(*value) : std::nullopt;
}
template <typename T>
void readRunText(const std::string& text, std::optional<T>& value) {
  readRunText(text, value.emplace());
}

enum class Written { kAlways, kUnlessDefault };

/// @param member  of a RunInfo, a reference to it.
template <typename Member>
RunTableRow runTableRow(const char* key, RunKeyRole role, bool is_shown, Member member,
                        Written written = Written::kAlways) {
  return {key, role, is_shown,
          [member, written](const RunInfo& info) {
            static const RunInfo kUntouched;
            const RunText text = runText(member(info));
            const bool is_default = text == runText(member(kUntouched));
            return is_default && written == Written::kUnlessDefault ? RunText() : text;
          },
          [member](RunInfo& info, const std::string& text) { readRunText(text, member(info)); }};
}

/// A member of a RunInfo by its pointer, and of what lies in it.
constexpr auto ofRun = [](auto member) {
  return [member](auto& info) -> auto& { return info.*member; };
};
constexpr auto ofConfiguration = [](auto member) {
  return [member](auto& info) -> auto& { return info.configuration.*member; };
};
constexpr auto ofSelection = [](auto member) {
  return [member](auto& info) -> auto& { return info.configuration.selection.*member; };
};
constexpr auto ofPresentation = [](auto member) {
  return [member](auto& info) -> auto& { return info.configuration.presentation.*member; };
};

using Role = RunKeyRole;

const RunTableRow kRunTableRows[] = {
    runTableRow("under_test", Role::kConfiguration, false,
                ofConfiguration(&RunConfiguration::under_test)),
    runTableRow("sequences", Role::kConfiguration, true, ofSelection(&ProblemSelection::sequences)),
    runTableRow("kinds", Role::kConfiguration, false, ofSelection(&ProblemSelection::kinds)),
    runTableRow("subset", Role::kConfiguration, true, ofSelection(&ProblemSelection::subset)),
    runTableRow("seed", Role::kConfiguration, true, ofSelection(&ProblemSelection::seed)),
    runTableRow("shard", Role::kShard, true, ofSelection(&ProblemSelection::shard)),
    runTableRow("root", Role::kOwn, false, ofSelection(&ProblemSelection::root),
                Written::kUnlessDefault),
    runTableRow("presentation", Role::kConfiguration, true,
                ofPresentation(&PresentationOptions::kind)),
    // What yaw_only was called first.
    runTableRow("upright", Role::kConfiguration, true,
                ofPresentation(&PresentationOptions::yaw_only)),
    // Runs without it were made before there was one.
    runTableRow("audit", Role::kConfiguration, true, ofPresentation(&PresentationOptions::audit),
                Written::kUnlessDefault),
    runTableRow("results", Role::kConfiguration, true, ofConfiguration(&RunConfiguration::results),
                Written::kUnlessDefault),
    runTableRow("foreign_replies", Role::kOwn, true, ofRun(&RunInfo::foreign_replies),
                Written::kUnlessDefault),
    runTableRow("time_limit", Role::kConfiguration, true,
                ofConfiguration(&RunConfiguration::time_limit)),
    runTableRow("handshake", Role::kConfiguration, false,
                ofConfiguration(&RunConfiguration::handshake)),
    runTableRow("global_guess", Role::kConfiguration, true,
                ofConfiguration(&RunConfiguration::global_guess)),
    runTableRow("debug", Role::kConfiguration, true, ofConfiguration(&RunConfiguration::debug)),
    runTableRow("metric_version", Role::kConfiguration, true, ofRun(&RunInfo::metric_version)),
    runTableRow("code_version", Role::kRecorded, true, ofRun(&RunInfo::code_version),
                Written::kUnlessDefault),
    runTableRow("secret", Role::kOwn, false, ofRun(&RunInfo::secret)),
    runTableRow("created", Role::kOwn, false, ofRun(&RunInfo::created)),
    runTableRow("problems", Role::kOwn, false, ofRun(&RunInfo::problems)),
    runTableRow("client", Role::kClient, false, ofRun(&RunInfo::client)),
    runTableRow("client_parameters", Role::kClient, false, ofRun(&RunInfo::client_parameters)),
    runTableRow("node_cpu_time_s", Role::kOwn, false, ofRun(&RunInfo::node_cpu_time),
                Written::kUnlessDefault),
    runTableRow("node_peak_memory_bytes", Role::kOwn, false, ofRun(&RunInfo::node_peak_memory),
                Written::kUnlessDefault),
    runTableRow("merged_from", Role::kRecorded, false, ofRun(&RunInfo::merged_from),
                Written::kUnlessDefault),
};

}  // namespace

std::string inBackticks(const std::optional<std::string>& text) {
  return text ? "`" + *text + "`" : "nothing";
}

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
  const auto rows = std::find_if(list.begin(), list.end(),
                                 [&](const auto& known) { return startsWith(key, known.prefix); });
  return rows == list.end() ? nullptr : &*rows;
}

}  // namespace pcrb
