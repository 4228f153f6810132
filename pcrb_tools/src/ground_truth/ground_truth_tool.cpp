#include "ground_truth/ground_truth_tool.hpp"

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <set>

#include "common/process.hpp"
#include "common/progress.hpp"
#include "common/tool_main.hpp"
#include "ground_truth/pair_evaluation.hpp"
#include "ground_truth/pickled_pairs.hpp"
#include "pcrb_core/error.hpp"
#include "pcrb_core/io/atomic_file.hpp"
#include "pcrb_core/io/number.hpp"
#include "pcrb_core/problem/dataset.hpp"
#include "pcrb_core/problem/problem.hpp"

namespace pcrb_tools {
namespace {

namespace fs = std::filesystem;
using pcrb::SequenceFiles;

std::vector<SequenceFiles> findWanted(const GroundTruthOptions& options) {
  if (options.root.empty()) return {};
  std::vector<SequenceFiles> all = pcrb::findSequences(options.root);
  all.erase(std::remove_if(all.begin(), all.end(),
                           [&](const SequenceFiles& files) { return files.kind != options.kind; }),
            all.end());
  std::vector<pcrb::SequenceName> names;
  for (const SequenceFiles& files : all) names.push_back({files.data_set, files.sequence});
  const std::string expected = std::string("a problem file <sequence>_") + toString(options.kind);
  std::vector<SequenceFiles> wanted;
  for (const std::size_t i :
       pcrb::selectNamed(names, options.sequences, [&](const std::string& word) {
         throw pcrb::InvalidFile(options.root, 0, "no '" + word + "'", expected + ".txt of it");
       })) {
    wanted.push_back(all[i]);
  }
  if (wanted.empty()) throw pcrb::InvalidFile(options.root, 0, "none", expected + ".txt");
  return wanted;
}

/// The different pairs of a problem file, at most so many, evenly over the file, those of a target
/// together.
std::vector<PairNames> choosePairs(const std::string& problem_file, std::size_t max_pairs) {
  std::vector<PairNames> all;
  std::set<std::pair<std::string, std::string>> seen;
  for (const pcrb::Problem& problem : pcrb::readProblemFile(problem_file)) {
    if (seen.emplace(problem.source, problem.target).second) {
      all.push_back({problem.source, problem.target});
    }
  }
  const std::size_t count = max_pairs == 0 ? all.size() : std::min(max_pairs, all.size());
  std::vector<PairNames> chosen;
  for (std::size_t i = 0; i < count; ++i) chosen.push_back(all[i * all.size() / count]);
  std::stable_sort(chosen.begin(), chosen.end(),
                   [](const PairNames& a, const PairNames& b) { return a.target < b.target; });
  return chosen;
}

/// One sequence's pairs and the file of their misalignments.
class SequenceEvaluation {
 public:
  SequenceEvaluation(const SequenceFiles& files, const GroundTruthOptions& options)
      : files_(files),
        options_(options),
        radius_(options.radius ? *options.radius
                               : pcrb::loadDataset(options.root, files.data_set).overlap_distance),
        pairs_(choosePairs(files.problem_file, options.max_pairs)),
        output_(
            describe(options.output + "/pairs/" + files.data_set + "_" + files.sequence + ".csv")),
        partial_(describe(output_.path() + ".partial")) {}

  PairFile run() const {
    if (isKept(output_, options_.force)) return readPairFile(output_.path());
    const PairFile file = evaluate();
    output_.begin();
    pcrb::writeFileAtomically(output_.path(), file.text);
    output_.record();
    fs::remove(partial_.path());
    fs::remove(pcrb::sideFile(partial_.path()));
    return file;
  }

 private:
  pcrb::DerivedFile describe(const std::string& path) const {
    pcrb::DerivedFile file(path, "evaluate_ground_truth");
    file.setParameter("radius", pcrb::formatShortest(radius_));
    file.setParameter("kind", toString(files_.kind));
    file.setParameter("pairs", std::to_string(options_.max_pairs));
    file.addInput(files_.problem_file);
    std::set<std::string> clouds;
    for (const PairNames& pair : pairs_) clouds.insert({pair.source, pair.target});
    for (const std::string& name : clouds) file.addInput(files_.cloud_folder + "/" + name);
    return file;
  }

  /// What an interrupted run has left of this, else no pair.
  PairFile resume() const {
    if (partial_.isBegun()) return readPairFile(partial_.path());
    fs::remove(partial_.path());
    partial_.begin();
    return emptyPairFile();
  }

  PairFile evaluate() const {
    PairFile file = resume();
    Progress progress(files_.sequence, "pairs", pairs_.size());
    progress.keep(file.pairs());
    PairEvaluator evaluator(files_.cloud_folder, radius_, options_.threads);
    while (file.pairs() < pairs_.size()) {
      Interruption::check();
      evaluator.evaluate(pairs_[file.pairs()], file);
      pcrb::writeFileAtomically(partial_.path(), file.text);
      progress.add();
    }
    progress.finish();
    return file;
  }

  const SequenceFiles& files_;
  const GroundTruthOptions& options_;
  double radius_;  // m
  std::vector<PairNames> pairs_;
  pcrb::DerivedFile output_;
  pcrb::DerivedFile partial_;  ///< grows pair by pair
};

SequenceAccuracy assess(const std::string& data_set, const std::string& sequence, PairFile pairs) {
  SequenceAccuracy result;
  result.data_set = data_set;
  result.sequence = sequence;
  result.pairs = std::move(pairs);
  if (!result.isKnown()) return result;
  result.accuracy = pcrb::assessGroundTruth(result.pairs.misalignments);
  result.translation = pcrb::describe(result.pairs.translations);
  result.rotation_deg = pcrb::describe(result.pairs.rotations_deg);
  return result;
}

SequenceAccuracy importFile(const std::string& import) {
  const std::size_t equals = import.find('=');
  if (equals == 0 || equals == std::string::npos) {
    throw pcrb::InvalidParameter("import: found '" + import +
                                 "', expected <data set>=<path>/<sequence>.csv, or _gt_check.dat");
  }
  const std::string path = import.substr(equals + 1);
  if (isPickled(path)) {
    return assess(import.substr(0, equals), sequenceOfPickled(path),
                  parsePairFile(readPickledPairs(path), path));
  }
  return assess(import.substr(0, equals), fs::path(path).stem().string(), readPairFile(path));
}

}  // namespace

void runGroundTruthTool(const GroundTruthOptions& options, std::ostream& out) {
  if (options.root.empty() && options.imports.empty()) {
    throw pcrb::InvalidParameter("found neither a root nor an import, expected one of them");
  }
  std::vector<SequenceAccuracy> sequences;
  for (const std::string& import : options.imports) sequences.push_back(importFile(import));
  const Interruption interruption;
  const std::vector<SequenceFiles> wanted = findWanted(options);
  fs::create_directories(options.output + "/pairs");
  for (const SequenceFiles& files : wanted) {
    sequences.push_back(
        assess(files.data_set, files.sequence, SequenceEvaluation(files, options).run()));
  }
  if (std::none_of(sequences.begin(), sequences.end(), [](const auto& s) { return s.isKnown(); })) {
    throw pcrb::InvalidProblem("found no pair that could be aligned (reasons: " + options.output +
                               "/pairs), expected one at least");
  }
  markWorst(sequences);
  const std::string text = formatText(sequences);
  pcrb::writeFileAtomically(options.output + "/ground_truth.csv", formatCsv(sequences));
  pcrb::writeFileAtomically(options.output + "/ground_truth.txt", text);
  pcrb::writeFileAtomically(options.output + "/ground_truth.svg", plotSvg(sequences));
  pcrb::writeFileAtomically(options.output + "/ground_truth_pairs.svg", plotPairsSvg(sequences));
  out << text << std::flush;
}

}  // namespace pcrb_tools
