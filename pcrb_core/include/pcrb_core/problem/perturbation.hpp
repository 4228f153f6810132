#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "pcrb_core/problem/dataset.hpp"
#include "pcrb_core/problem/pair_sampling.hpp"
#include "pcrb_core/random.hpp"
#include "pcrb_core/transform.hpp"

namespace pcrb {

/// Rotation about a centre, then a translation: Trans(c) · Trans(t) · R · Trans(−c).
/// Source: Fontana et al. 2021, section 3.1.
Transform makePerturbation(const Eigen::Vector3d& center, const Eigen::Vector3d& translation,
                           const Eigen::Matrix3d& rotation);

/// How far a perturbation of a data set may move the source's centroid, m: its bound × 1.1 + 0.2.
double maxCentroidMotion(const PerturbationBounds& bounds);

/// Checks that a perturbation moves the source's centroid no farther than its data set's bound
/// allows (maxCentroidMotion): else the clouds are in another frame than the problem file's.
///
/// @param source_centroid  m, in the data set's frame.
/// @throws InvalidProblem  saying how far the centroid moves, the bound, and the likely cause.
void checkFrame(const Transform& P, const Eigen::Vector3d& source_centroid,
                const PerturbationBounds& bounds);

/// Perturbations per pair of a list: 30 for local, 1 for global problems.
std::size_t perturbationsPerPair(Kind kind);

/// A random perturbation about a source's centroid: direction of the translation and axis of the
/// rotation each uniform on the sphere, magnitudes uniform between the bounds.
///
/// @param source_centroid  m, in the data set's frame.
/// Source: Fontana et al. 2021, section 3.1.
Transform samplePerturbation(const Eigen::Vector3d& source_centroid,
                             const PerturbationBounds& bounds, Random& random);

/// Seed of an independent stream of random numbers for one purpose, e.g. `plain local pairs`.
std::uint64_t streamSeed(std::uint64_t seed, const std::string& purpose);

/// What the problems of a list are made of.
struct ProblemList {
  std::string sequence;  ///< gives the ids their first digits
  Kind kind = Kind::kLocal;
  std::vector<CloudPair> pairs;
  PerturbationBounds bounds;
};

/// The problems of a list: perturbationsPerPair(kind) for each pair, with the published ids.
///
/// The perturbations depend on the seed, the sequence's name, the kind and the order of pairs only.
/// @param centroid  a source's centroid, m, in the data set's frame.
std::vector<Problem> sampleProblems(
    const ProblemList& list, std::uint64_t seed,
    const std::function<Eigen::Vector3d(const std::string& source)>& centroid);

}  // namespace pcrb
