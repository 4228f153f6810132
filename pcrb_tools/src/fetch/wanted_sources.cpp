#include "fetch/wanted_sources.hpp"

#include <algorithm>
#include <set>
#include <string>

#include "pcrb_core/error.hpp"

namespace pcrb_tools {
namespace {

bool isOfSet(const FetchOptions& options, const Source& source) {
  return options.original ? source.is_original : source.is_published;
}

/// Whether a word of the selection names the source.
bool isNamed(const std::string& word, const Source& source) {
  return word == source.data_set || word == source.name();
}

bool isWanted(const FetchOptions& options, const Source& source) {
  const auto names_it = [&](const std::string& word) { return isNamed(word, source); };
  return isOfSet(options, source) &&
         (options.sequences.empty() ||
          std::any_of(options.sequences.begin(), options.sequences.end(), names_it));
}

}  // namespace

std::vector<Source> findWantedSources(const FetchOptions& options) {
  const std::vector<Source> all = readSources(options.sources);
  for (const std::string& word : options.sequences) {
    const bool is_known = std::any_of(all.begin(), all.end(), [&](const Source& source) {
      return isOfSet(options, source) && isNamed(word, source);
    });
    if (!is_known) {
      throw pcrb::InvalidParameter(options.sources + ": found no source of '" + word +
                                   "', expected <data set> or <data set>/<sequence>");
    }
  }
  std::set<std::string> needed;
  for (const Source& source : all) {
    if (isWanted(options, source)) needed.insert(source.needs);
  }
  std::vector<Source> wanted;
  for (const Source& source : all) {
    const bool is_needed = isOfSet(options, source) && source.kind != SourceKind::kProblems &&
                           needed.count(source.name()) > 0;
    if (is_needed || isWanted(options, source)) wanted.push_back(source);
  }
  return wanted;
}

}  // namespace pcrb_tools
