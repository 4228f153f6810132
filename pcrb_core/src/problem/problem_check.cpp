#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "pcrb_core/error.hpp"
#include "pcrb_core/io/number.hpp"
#include "pcrb_core/io/text.hpp"
#include "pcrb_core/problem/dataset_check.hpp"
#include "pcrb_core/problem/pair_sampling.hpp"
#include "pcrb_core/problem/perturbation.hpp"
#include "pcrb_core/problem/problem.hpp"
#include "problem/frame_offset.hpp"

namespace pcrb {
namespace {

/// Translations of a perturbation beyond this, m, come from a frame whose origin is far away.
constexpr double kLargeTranslation = 1000.0;

/// Four decimals of a problem file.
constexpr double kOverlapRounding = 5e-5;

/// The checks of one problem file.
class ProblemCheck {
 public:
  ProblemCheck(const SequenceFiles& files, const Dataset& dataset, const CloudSummaries& summaries)
      : files_(files),
        bounds_(dataset.bounds(files.kind)),
        summaries_(summaries),
        problems_(readProblemFile(files.problem_file)) {}

  std::vector<Finding> run() {
    checkClouds();
    checkTransforms();
    checkFrame();
    checkSpans();
    checkIds();
    checkPairs();
    return findings_;
  }

 private:
  void find(Severity severity, const std::string& what) {
    findings_.push_back({severity, files_.problem_file, what});
  }

  const CloudSummary* summaryOf(const std::string& name) const {
    const auto found = summaries_.find(name);
    return found != summaries_.end() && found->second ? &*found->second : nullptr;
  }

  void checkClouds() {
    std::set<std::string> named;
    std::set<std::string> absent;
    for (const Problem& problem : problems_) {
      for (const std::string& name : {problem.source, problem.target}) {
        named.insert(name);
        if (summaries_.count(name) == 0) absent.insert(name);
      }
    }
    if (absent.empty()) return;
    find(Severity::kError, outOf(absent.size(), named.size()) +
                               " clouds that it names are not in " + files_.cloud_folder +
                               ", e.g. " + *absent.begin());
  }

  /// Rigid perturbations by row; others are findings.
  void checkTransforms() {
    double largest = 0.0;
    for (std::size_t i = 0; i < problems_.size(); ++i) {
      try {
        const Transform P = requireRigid(problems_[i].perturbation);
        rigid_.emplace_back(i, P);
        largest = std::max(largest, P.translation().norm());
      } catch (const InvalidProblem& error) {
        findings_.push_back(
            {Severity::kError, files_.problem_file + ":" + std::to_string(i + 2), error.what()});
      }
    }
    if (largest > kLargeTranslation) noteFarFrame(largest);
  }

  /// All rows of a source rotate about one centroid, which they therefore tell: that of the clouds
  /// that the file was made with.
  void noteFarFrame(double largest) {
    std::map<std::string, std::vector<PerturbedCentroid>> rows_of;
    for (const auto& [i, P] : rigid_) {
      rows_of[problems_[i].source].push_back({P, Eigen::Vector3d::Zero()});
    }
    find(Severity::kNote, "perturbations translate by up to " + formatFixed(largest, 0) +
                              " m, since they are expressed in a frame with a far origin" +
                              describeCentroids(rows_of));
  }

  void checkFrame() {
    std::vector<PerturbedCentroid> rows;
    std::size_t outside = 0;
    double largest = 0.0;
    for (const auto& [i, P] : rigid_) {
      const CloudSummary* source = summaryOf(problems_[i].source);
      if (source == nullptr) continue;
      rows.push_back({P, source->centroid});
      const double motion = centroidMotion(rows.back(), Eigen::Vector3d::Zero());
      largest = std::max(largest, motion);
      outside += motion > maxCentroidMotion(bounds_) ? 1 : 0;
    }
    if (outside == 0) return;
    find(Severity::kError,
         outOf(outside, rows.size()) + " rows move the source's centroid too far, by up to " +
             formatFixed(largest, 1) + " m where at most " +
             formatFixed(maxCentroidMotion(bounds_), 2) +
             " m is possible: the clouds are in another frame than the problem file's; " +
             explainOffset(rows, maxCentroidMotion(bounds_)));
  }

  void checkSpans() {
    std::set<std::string> reported;
    for (const Problem& problem : problems_) {
      const CloudSummary* source = summaryOf(problem.source);
      const CloudSummary* target = summaryOf(problem.target);
      if (source == nullptr || target == nullptr) continue;
      const Eigen::AlignedBox3d both = source->box.merged(target->box);
      const Eigen::Vector3d center = target->box.center();
      const double span =
          std::max((both.max() - center).maxCoeff(), (center - both.min()).maxCoeff());
      // The local origin is the grid point nearest to the target's centre.
      if (span + kLocalOriginGrid / 2.0 <= kMaxSpan) continue;
      if (!reported.insert(problem.source + " " + problem.target).second) continue;
      find(Severity::kError,
           problem.source + " and " + problem.target + " reach " + formatFixed(span, 0) +
               " m from the target's centre, expected at most " +
               formatFixed(kMaxSpan - kLocalOriginGrid / 2.0, 0) + " m: they cannot be served");
    }
  }

  void checkIds() {
    const std::string first = problemId(files_.sequence, 0, 1);
    const std::string prefix = first.substr(0, first.size() - 2);
    const auto others = static_cast<std::size_t>(
        std::count_if(problems_.begin(), problems_.end(),
                      [&](const Problem& problem) { return !startsWith(problem.id, prefix); }));
    if (others == 0) return;
    find(Severity::kNote, outOf(others, problems_.size()) + " ids do not begin with " + prefix +
                              ", the CRC-32 of the sequence's name");
  }

  void checkPairs() {
    std::map<std::string, std::size_t> rows_of;
    std::set<std::string> rows;
    std::size_t repeated_rows = 0;
    for (const Problem& problem : problems_) {
      const std::string pair = problem.source + " " + problem.target;
      ++rows_of[pair];
      std::string row = pair;
      for (Eigen::Index i = 0; i < 12; ++i) {
        row += ' ';
        appendShortest(row, problem.perturbation(i / 4, i % 4));
      }
      repeated_rows += rows.insert(row).second ? 0 : 1;
    }
    if (repeated_rows > 0) {
      find(Severity::kWarning, outOf(repeated_rows, problems_.size()) +
                                   " rows repeat an earlier one, perturbation included");
    }
    const std::size_t lists = problems_.size() / perturbationsPerPair(files_.kind);
    if (rows_of.size() < lists) {
      find(Severity::kNote, "has " + std::to_string(rows_of.size()) + " different pairs in " +
                                std::to_string(lists) + ": some repeat");
    }
    checkMap();
  }

  /// All against one map: no bounds on overlap. Some against the folder's map: known of p2at_met.
  void checkMap() {
    std::set<std::string> targets;
    for (const Problem& problem : problems_) targets.insert(problem.target);
    if (targets.size() == 1 && problems_.size() > perturbationsPerPair(files_.kind)) {
      find(Severity::kNote, "poses every source against " + *targets.begin() +
                                ", with overlaps from " + formatFixed(lowestOverlap(), 4));
      return;
    }
    const auto on_map = std::count_if(problems_.begin(), problems_.end(),
                                      [](const Problem& p) { return p.target == kMapCloud; });
    if (on_map > 0) {
      find(Severity::kNote,
           std::to_string(on_map) + " rows have the map " + kMapCloud + " as target");
    }
    if (lowestOverlap() < minimalOverlap(files_.kind) - kOverlapRounding) {
      find(Severity::kNote, "has overlaps from " + formatFixed(lowestOverlap(), 4) +
                                ", where sampling begins at " +
                                formatFixed(minimalOverlap(files_.kind), 1));
    }
  }

  double lowestOverlap() const {
    double lowest = 1.0;
    for (const Problem& problem : problems_) lowest = std::min(lowest, problem.overlap);
    return lowest;
  }

  const SequenceFiles& files_;
  const PerturbationBounds& bounds_;
  const CloudSummaries& summaries_;
  std::vector<Problem> problems_;
  std::vector<std::pair<std::size_t, Transform>> rigid_;  ///< row and perturbation
  std::vector<Finding> findings_;
};

}  // namespace

std::vector<Finding> checkProblems(const SequenceFiles& files, const Dataset& dataset,
                                   const CloudSummaries& summaries) {
  try {
    return ProblemCheck(files, dataset, summaries).run();
  } catch (const InvalidFile& error) {
    return {{Severity::kError, "", error.what()}};  // the message begins with file and line
  }
}

}  // namespace pcrb
