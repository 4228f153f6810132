#include "ground_truth/pair_evaluator.hpp"

#include <utility>

#include "pcrb_core/evaluation/metric.hpp"
#include "pcrb_core/io/number.hpp"
#include "pcrb_core/io/pcd.hpp"

namespace pcrb_tools {

PairEvaluator::PairEvaluator(std::string folder, double radius, int threads)
    : folder_(std::move(folder)),
      method_(pcrb::makeRegistration("ppcr", {{"voxel_leaf", "0"},
                                              {"sampling_fraction", "1"},
                                              {"neighbors", "10"},
                                              {"search_radius", pcrb::formatShortest(radius)},
                                              {"cut_quantile", "1"},
                                              {"robust", "false"},
                                              {"threads", std::to_string(threads)}})) {}

void PairEvaluator::evaluate(const PairNames& pair, PairFile& file) {
  try {
    setTarget(pair.target);
    align(pair, file);
  } catch (const pcrb::RegistrationFailed& failure) {
    addFailed(file, pair, failure.what());
  } catch (const pcrb::InvalidProblem& error) {
    addFailed(file, pair, error.what());
  }
}

void PairEvaluator::setTarget(const std::string& name) {
  if (name == target_) return;
  target_.clear();
  const pcrb::DatasetCloud cloud = pcrb::readPcd(folder_ + "/" + name);
  local_origin_ = pcrb::chooseLocalOrigin(cloud);
  method_->setTarget(
      std::make_shared<const pcrb::PointCloud>(pcrb::makeLocal(cloud, local_origin_)));
  target_ = name;
}

void PairEvaluator::align(const PairNames& pair, PairFile& file) {
  const pcrb::PointCloud source =
      pcrb::makeLocal(pcrb::readPcd(folder_ + "/" + pair.source), local_origin_);
  const pcrb::Metric metric(source);
  const auto result = method_->align(source, pcrb::Transform::Identity());
  addAligned(file, pair, metric.unnormalized(result.T_target_source),
             pcrb::inLocalFrame(result.T_target_source, metric.centroid()), result.reason);
}

}  // namespace pcrb_tools
