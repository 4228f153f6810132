#include <algorithm>
#include <array>

#include "pcrb_core/problem/dataset.hpp"
#include "report/published.hpp"

namespace pcrb_tools {
namespace {

struct CatalogSequence {
  const char* name;
  const char* data_set;
  const char* environment;
  const char* structure;
};

/// The paper's sequences in the order of its tables. Environment and structure are this suite's own
/// assignment, from what the places are known to be; they were not checked against the paper's
/// Tables 2 and 3, and the report says so.
constexpr std::array<CatalogSequence, 15> kCatalog{{
    {"plain", "eth", "outdoor", "unstructured"},
    {"stairs", "eth", "indoor and outdoor", "structured"},
    {"apartment", "eth", "indoor", "structured"},
    {"hauptgebaude", "eth", "indoor", "structured"},
    {"wood_autumn", "eth", "outdoor", "unstructured"},
    {"wood_summer", "eth", "outdoor", "unstructured"},
    {"gazebo_summer", "eth", "outdoor", "semi-structured"},
    {"gazebo_winter", "eth", "outdoor", "semi-structured"},
    {"box_met", "planetary", "outdoor", "unstructured"},
    {"p2at_met", "planetary", "outdoor", "unstructured"},
    {"planetary_map", "planetary", "outdoor", "unstructured"},
    {"pioneer_slam", "tum", "indoor", "structured"},
    {"pioneer_slam3", "tum", "indoor", "structured"},
    {"long_office_household", "tum", "indoor", "structured"},
    {"urban05", "kaist", "outdoor", "structured"},
}};

const CatalogSequence* findInCatalog(const std::string& name) {
  const auto* found =
      std::find_if(kCatalog.begin(), kCatalog.end(),
                   [&](const CatalogSequence& sequence) { return sequence.name == name; });
  return found == kCatalog.end() ? nullptr : found;
}

}  // namespace

std::size_t publishedPlace(const std::string& sequence) {
  const CatalogSequence* known = findInCatalog(sequence);
  return known == nullptr ? kCatalog.size() : static_cast<std::size_t>(known - kCatalog.data());
}

std::map<std::string, std::string> knownSequences(const std::string& root) {
  std::map<std::string, std::string> data_sets;
  for (const CatalogSequence& sequence : kCatalog) data_sets[sequence.name] = sequence.data_set;
  if (root.empty()) return data_sets;
  for (const pcrb::SequenceFiles& files : pcrb::findSequences(root)) {
    data_sets.emplace(files.sequence, files.data_set);
  }
  return data_sets;
}

bool isInPaper(const std::string& data_set, const std::string& sequence) {
  const CatalogSequence* known = findInCatalog(sequence);
  return known != nullptr && data_set == known->data_set;
}

std::size_t paperSequenceCount() { return kCatalog.size(); }

std::vector<std::string> characteristicsOf(const std::string& root, const std::string& data_set,
                                           const std::string& sequence) {
  std::vector<std::string> words;
  const auto add = [&](const std::string& word) {
    const bool is_new = std::find(words.begin(), words.end(), word) == words.end();
    if (!word.empty() && is_new) words.push_back(word);
  };
  if (isInPaper(data_set, sequence)) {
    add(findInCatalog(sequence)->environment);
    add(findInCatalog(sequence)->structure);
  }
  const pcrb::Dataset dataset = pcrb::loadDataset(root.empty() ? "/nonexistent" : root, data_set);
  add(dataset.sensor);
  for (const std::string& word : dataset.characteristics) add(word);
  return words;
}

}  // namespace pcrb_tools
