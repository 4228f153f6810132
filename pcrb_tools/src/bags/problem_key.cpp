#include "bags/problem_key.hpp"

#include <cstdint>
#include <limits>
#include <set>
#include <string_view>
#include <vector>

#include "pcrb_core/error.hpp"
#include "pcrb_core/io/file_bytes.hpp"
#include "pcrb_core/io/number.hpp"
#include "pcrb_core/io/text.hpp"
#include "pcrb_core/problem/secret.hpp"

namespace pcrb_tools {
namespace {

constexpr const char* kExpected =
    "`problem_file NAME HASH`, `presentation NAME`, `upright true` or `false`, `subset NUMBER "
    "SEED`, `secret HEX` or "
    "`problem PUBLIC_ID STAMP OFFICIAL_ID`";

using Fields = std::vector<std::string>;

/// Words of a line after the first, by which the line is known.
const std::map<std::string_view, std::size_t> kWords{{"problem_file", 2}, {"presentation", 1},
                                                     {"upright", 1},      {"subset", 2},
                                                     {"secret", 1},       {"problem", 3}};

/// Whether both are whole numbers that an int holds, not negative.
bool takeSubset(const Fields& fields, ProblemKey& key) {
  const auto subset = pcrb::parseUnsigned(fields[1]);
  const auto seed = pcrb::parseUnsigned(fields[2]);
  constexpr auto kMax = static_cast<std::uint64_t>(std::numeric_limits<int>::max());
  if (!subset || !seed || *subset > kMax || *seed > kMax) return false;
  key.subset = *subset;
  key.seed = *seed;
  return true;
}

/// A row of a problem; whether it can be one.
bool takeProblem(const Fields& fields, ProblemKey& key) {
  const auto stamp = pcrb::parseStamp(fields[2]);
  return stamp && key.rows.emplace(*stamp, ProblemKey::Row{fields[1], fields[3]}).second;
}

bool take(const Fields& fields, ProblemKey& key) {
  if (fields[0] == "problem") return takeProblem(fields, key);
  if (fields[0] == "subset") return takeSubset(fields, key);
  if (fields[0] == "problem_file") {
    key.problem_file = fields[1];
    key.hash = fields[2];
  } else if (fields[0] == "presentation") {
    key.presentation.kind = pcrb::presentationFromString(fields[1]);
  } else if (fields[0] == "upright") {
    key.presentation.yaw_only = fields[1] == "true";
    return key.presentation.yaw_only || fields[1] == "false";
  } else {
    key.secret = pcrb::Secret::fromHex(fields[1]);
  }
  return true;
}

void takeLine(const pcrb::LineReader& reader, std::string_view line, std::set<std::string>& seen,
              ProblemKey& key) {
  std::vector<std::string_view> views;
  pcrb::splitAtBlanks(line, views);
  const Fields fields(views.begin(), views.end());
  const auto known = kWords.find(fields[0]);
  bool is_good = known != kWords.end() && fields.size() == known->second + 1;
  is_good = is_good && (fields[0] == "problem" || seen.insert(fields[0]).second);
  try {
    is_good = is_good && take(fields, key);
  } catch (const pcrb::InvalidParameter&) {
    is_good = false;
  }
  if (!is_good) reader.fail(pcrb::inQuotes(line), kExpected);
}

}  // namespace

std::string formatProblemKey(const ProblemKey& key) {
  std::string text =
      "# Key of a bag of registration problems: score_poses scores with it the poses that come "
      "back. Keep it.\n";
  text += "problem_file " + key.problem_file + ' ' + key.hash + '\n';
  text += std::string("presentation ") + pcrb::toString(key.presentation.kind) + '\n';
  text += std::string("upright ") + (key.presentation.yaw_only ? "true" : "false") + '\n';
  text += "subset " + std::to_string(key.subset) + ' ' + std::to_string(key.seed) + '\n';
  text += "secret " + key.secret.value().toHex() + '\n';
  for (const auto& [stamp, row] : key.rows) {
    text +=
        "problem " + row.public_id + ' ' + pcrb::formatStamp(stamp) + ' ' + row.official_id + '\n';
  }
  return text;
}

ProblemKey readProblemKey(const std::string& path) {
  const pcrb::FileBytes bytes(path);
  pcrb::LineReader reader(bytes.text(), path);
  ProblemKey key;
  std::set<std::string> seen;
  std::string_view line;
  while (reader.nextDataRow(line)) takeLine(reader, line, seen, key);
  if (seen.size() != kWords.size() - 1 || key.rows.empty()) {
    throw pcrb::InvalidFile(path, 0, "an incomplete key", kExpected);
  }
  return key;
}

}  // namespace pcrb_tools
