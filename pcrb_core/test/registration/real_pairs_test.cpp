// Real scans against the accuracy that a method has to have. Skipped without the shared data.

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <memory>

#include "pcrb_core/evaluation/metric.hpp"
#include "pcrb_core/io/number.hpp"
#include "pcrb_core/io/pcd.hpp"
#include "pcrb_core/problem/dataset.hpp"
#include "pcrb_core/problem/problem.hpp"
#include "pcrb_core/registration/registration.hpp"
#include "support/scenes.hpp"
#include "support/shared_data.hpp"

namespace pcrb {
namespace {

/// Every `step`-th problem of a sequence, as the paper presents it: the source moved by P.
struct Expectation {
  const char* method;
  const char* data_set;
  const char* sequence;
  const char* kind;
  std::size_t step;
  double median;  ///< of the benchmark's error, at most
};

std::string nameOf(const ::testing::TestParamInfo<Expectation>& expectation) {
  return std::string(expectation.param.method) + "_" + expectation.param.sequence + "_" +
         expectation.param.kind;
}

class RealPairs : public ::testing::TestWithParam<Expectation> {
 protected:
  std::unique_ptr<Registration> makeMethod() const {
    Parameters parameters = registrationDefaults(GetParam().method);
    const Dataset dataset = loadDataset(root(), GetParam().data_set);
    parameters.at("voxel_leaf") = formatShortest(dataset.voxel_leaf);
    return makeRegistration(GetParam().method, parameters);
  }

  std::vector<double> errors() {
    const auto method = makeMethod();
    const auto problems = readProblemFile(folder() + "_" + GetParam().kind + ".txt");
    std::vector<double> result;
    for (std::size_t i = 0; i < problems.size(); i += GetParam().step) {
      result.push_back(errorOf(*method, problems[i]));
    }
    return result;
  }

 private:
  static std::string root() { return pcrb_test::sharedData() + "/benchmark"; }
  std::string folder() const {
    return root() + "/" + GetParam().data_set + "/" + GetParam().sequence;
  }

  double errorOf(Registration& method, const Problem& problem) {
    const Eigen::Vector3d origin = chooseLocalOrigin(cloud(problem.target));
    if (problem.target != target_) {
      method.setTarget(pcrb_test::shared(makeLocal(cloud(problem.target), origin)));
      target_ = problem.target;
    }
    const PointCloud source = makeLocal(cloud(problem.source), origin);
    const Transform P = inLocalFrame(requireRigid(problem.perturbation), origin);
    try {
      const auto result = method.align(pcrb_test::transformed(source, P), Transform::Identity());
      return Metric(source).evaluate(result.T_target_source * P).error;
    } catch (const RegistrationFailed&) {
      return Metric(source).evaluate(P).error;
    }
  }

  const DatasetCloud& cloud(const std::string& name) {
    const auto [entry, is_new] = clouds_.try_emplace(name);
    if (is_new) entry->second = readPcd(folder() + "/" + name);
    return entry->second;
  }

  std::map<std::string, DatasetCloud> clouds_;
  std::string target_;  // the method's, a file name
};

TEST_P(RealPairs, AreAlignedAsAccuratelyAsTheyHaveToBe) {
  PCRB_REQUIRE_SHARED_DATA();
  std::vector<double> all = errors();
  const auto middle = all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2);
  std::nth_element(all.begin(), middle, all.end());
  EXPECT_LT(*middle, GetParam().median);
}

INSTANTIATE_TEST_SUITE_P(
    Local, RealPairs,
    ::testing::Values(Expectation{"icp", "automotive", "street", "local", 24, 0.03},
                      Expectation{"icp", "handheld", "car", "local", 24, 0.08},
                      Expectation{"gicp", "automotive", "street", "local", 24, 0.01},
                      Expectation{"gicp", "handheld", "car", "local", 24, 0.015},
                      Expectation{"gicp", "rgbd", "livingroom", "local", 24, 0.01},
                      Expectation{"ppcr", "automotive", "street", "local", 24, 0.02},
                      Expectation{"ppcr", "handheld", "car", "local", 24, 0.015},
                      Expectation{"ppcr", "rgbd", "livingroom", "local", 24, 0.03}),
    nameOf);

INSTANTIATE_TEST_SUITE_P(
    Global, RealPairs,
    ::testing::Values(Expectation{"ransac", "automotive", "street", "global", 1, 0.03},
                      Expectation{"ransac", "handheld", "car", "global", 1, 0.03},
                      Expectation{"ransac", "rgbd", "livingroom", "global", 7, 0.08},
                      Expectation{"fgr", "automotive", "street", "global", 1, 0.015},
                      Expectation{"fgr", "handheld", "car", "global", 1, 0.02},
                      Expectation{"fgr", "rgbd", "livingroom", "global", 7, 0.04},
                      Expectation{"teaser", "automotive", "street", "global", 1, 0.015},
                      Expectation{"teaser", "handheld", "car", "global", 1, 0.02},
                      Expectation{"teaser", "rgbd", "livingroom", "global", 7, 0.05}),
    nameOf);

}  // namespace
}  // namespace pcrb
