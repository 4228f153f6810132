#pragma once

#include <cstdlib>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "pcrb_core/evaluation/metric.hpp"
#include "pcrb_core/io/pcd.hpp"
#include "pcrb_core/problem/problem.hpp"

namespace pcrb_benchmark {

/// The problems of a sequence below $PCRB_SHARED_DATA/benchmark, clouds read once.
class RealSequence {
 public:
  /// One problem as the benchmark server hands it out, in a local frame.
  struct Pair {
    std::shared_ptr<const pcrb::PointCloud> target;
    pcrb::PointCloud truth;   ///< the source where it belongs
    pcrb::PointCloud source;  ///< P · truth
    pcrb::Transform P;
  };

  /// @param sequence  e.g. `automotive/street`.
  RealSequence(const std::string& sequence, const std::string& kind)
      : folder_(std::string(std::getenv("PCRB_SHARED_DATA")) + "/benchmark/" + sequence),
        problems_(pcrb::readProblemFile(folder_ + "_" + kind + ".txt")) {}

  std::size_t size() const { return problems_.size(); }

  Pair pair(std::size_t i) {
    const pcrb::Problem& problem = problems_.at(i);
    const Eigen::Vector3d origin = pcrb::chooseLocalOrigin(cloud(problem.target));
    Pair pair;
    pair.target = std::make_shared<pcrb::PointCloud>(makeLocal(cloud(problem.target), origin));
    pair.truth = makeLocal(cloud(problem.source), origin);
    pair.P = pcrb::inLocalFrame(pcrb::requireRigid(problem.perturbation), origin);
    pair.source = pair.truth;
    for (auto& point : pair.source.points) {
      point = (pair.P * point.cast<double>()).cast<float>();
    }
    return pair;
  }

 private:
  const pcrb::DatasetCloud& cloud(const std::string& name) {
    const auto [entry, is_new] = clouds_.try_emplace(name);
    if (is_new) entry->second = pcrb::readPcd(folder_ + "/" + name);
    return entry->second;
  }

  std::string folder_;
  std::vector<pcrb::Problem> problems_;
  std::map<std::string, pcrb::DatasetCloud> clouds_;
};

/// Error of an estimated T_target_source.
inline pcrb::PoseError scoreOf(const RealSequence::Pair& pair, const pcrb::Transform& T) {
  return pcrb::Metric(pair.truth).evaluate(T * pair.P);
}

}  // namespace pcrb_benchmark
