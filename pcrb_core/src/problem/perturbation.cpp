#include "pcrb_core/problem/perturbation.hpp"

#include <cmath>
#include <sstream>

#include "pcrb_core/error.hpp"
#include "pcrb_core/io/file_bytes.hpp"
#include "pcrb_core/problem/problem.hpp"

namespace pcrb {
namespace {

/// The published bounds are bounds of what was sampled; centroids of re-converted clouds differ a
/// little (docs/formats.md).
constexpr double kFrameFactor = 1.1;
constexpr double kFrameSlack = 0.2;

}  // namespace

Transform makePerturbation(const Eigen::Vector3d& center, const Eigen::Vector3d& translation,
                           const Eigen::Matrix3d& rotation) {
  Transform P = Transform::Identity();
  P.linear() = rotation;
  P.translation() = translation - (rotation - Eigen::Matrix3d::Identity()) * center;
  return P;
}

double maxCentroidMotion(const PerturbationBounds& bounds) {
  return bounds.translation.max * kFrameFactor + kFrameSlack;
}

void checkFrame(const Transform& P, const Eigen::Vector3d& source_centroid,
                const PerturbationBounds& bounds) {
  const Eigen::Vector3d motion =
      (P.linear() - Eigen::Matrix3d::Identity()) * source_centroid + P.translation();
  if (motion.norm() <= maxCentroidMotion(bounds)) return;
  std::ostringstream message;
  message << "found a perturbation that moves the source's centroid (" << source_centroid.x() << ' '
          << source_centroid.y() << ' ' << source_centroid.z() << ") by " << motion.norm()
          << " m, expected at most " << maxCentroidMotion(bounds)
          << " m: the clouds are in another frame than the problem file's (check_dataset estimates "
             "the offset between the two)";
  throw InvalidProblem(message.str());
}

namespace {

constexpr std::size_t kLocalPerturbations = 30;
/// A pair's share of the ids: those of its local problems and one for a global one.
constexpr std::size_t kIdsPerPair = kLocalPerturbations + 1;

std::size_t idIndex(Kind kind, std::size_t pair, std::size_t perturbation) {
  return kIdsPerPair * pair + (kind == Kind::kLocal ? perturbation : kLocalPerturbations);
}

/// The finalizer of SplitMix64: a bijection that spreads every bit over all.
std::uint64_t mixed(std::uint64_t bits) {
  bits = (bits ^ bits >> 30) * 0xbf58476d1ce4e5b9ULL;
  bits = (bits ^ bits >> 27) * 0x94d049bb133111ebULL;
  return bits ^ bits >> 31;
}

}  // namespace

std::size_t perturbationsPerPair(Kind kind) {
  return kind == Kind::kLocal ? kLocalPerturbations : 1;
}

Transform samplePerturbation(const Eigen::Vector3d& source_centroid,
                             const PerturbationBounds& bounds, Random& random) {
  const Eigen::Vector3d direction = random.direction();
  const double distance = random.uniform(bounds.translation.min, bounds.translation.max);
  const Eigen::Vector3d axis = random.direction();
  const double angle =
      random.uniform(bounds.rotation_deg.min, bounds.rotation_deg.max) * kRadiansPerDegree;
  return makePerturbation(source_centroid, distance * direction,
                          Eigen::AngleAxisd(angle, axis).toRotationMatrix());
}

std::uint64_t streamSeed(std::uint64_t seed, const std::string& purpose) {
  Fnv1a hash;
  hash.add(purpose);
  return mixed(hash.value() + mixed(seed));
}

std::vector<Problem> sampleProblems(
    const ProblemList& list, std::uint64_t seed,
    const std::function<Eigen::Vector3d(const std::string& source)>& centroid) {
  Random random(streamSeed(seed, list.sequence + " " + toString(list.kind) + " perturbations"));
  std::vector<Problem> problems;
  for (std::size_t k = 0; k < list.pairs.size(); ++k) {
    const CloudPair& pair = list.pairs[k];
    const Eigen::Vector3d center = centroid(pair.source);
    for (std::size_t j = 0; j < perturbationsPerPair(list.kind); ++j) {
      Problem problem;
      problem.id = problemId(list.sequence, idIndex(list.kind, k, j), list.pairs.size());
      problem.source = pair.source;
      problem.target = pair.target;
      problem.overlap = pair.overlap;
      problem.perturbation = samplePerturbation(center, list.bounds, random).matrix().topRows<3>();
      problems.push_back(problem);
    }
  }
  return problems;
}

}  // namespace pcrb
