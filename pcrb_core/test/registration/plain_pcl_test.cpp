// The paper's baselines: what PCL does with the paper's numbers typed in. The oracle is PCL, called
// here without anything of ours but the filters.

#include <gtest/gtest.h>
#include <pcl/registration/correspondence_rejection_median_distance.h>
#include <pcl/registration/gicp.h>
#include <pcl/registration/icp.h>
#include <pcl/registration/ndt.h>

#include <functional>

#include "pcrb_core/evaluation/metric.hpp"
#include "pcrb_core/evaluation/statistics.hpp"
#include "pcrb_core/io/pcd.hpp"
#include "pcrb_core/problem/dataset.hpp"
#include "pcrb_core/problem/problem.hpp"
#include "pcrb_core/registration/parameters.hpp"
#include "pcrb_core/registration/preprocessing.hpp"
#include "support/scenes.hpp"
#include "support/shared_data.hpp"

namespace pcrb {
namespace {

using pcrb_test::hall;
using pcrb_test::shared;
using pcrb_test::transformed;
using Cloud = pcl::PointCloud<pcl::PointXYZ>;

Cloud::Ptr cloudOf(const Points& points) {
  Cloud::Ptr cloud(new Cloud);
  for (const auto& point : points) cloud->push_back({point.x(), point.y(), point.z()});
  return cloud;
}

/// As a user of PCL would type the paper's numbers in: 35 iterations, 0.01 m, 3 × the median.
template <class PclMethod>
Transform plainPcl(PclMethod& method, const Points& target, const Points& source) {
  const pcl::registration::CorrespondenceRejectorMedianDistance::Ptr rejector(
      new pcl::registration::CorrespondenceRejectorMedianDistance);
  rejector->setMedianFactor(3.0);
  method.addCorrespondenceRejector(rejector);
  method.setMaximumIterations(35);
  method.setTransformationEpsilon(0.01);
  method.setInputTarget(cloudOf(target));
  method.setInputSource(cloudOf(source));
  Cloud aligned;
  method.align(aligned);
  return Transform(Eigen::Matrix4d(method.getFinalTransformation().template cast<double>()));
}

struct Pair {
  PointCloud target;
  PointCloud source;
  double leaf;  ///< m
};

Points near(const PointCloud& cloud, const Eigen::Vector3d& origin) {
  Points points;
  for (const auto& p : cloud.points) points.push_back((p.cast<double>() - origin).cast<float>());
  return points;
}

/// PCL's answer, in the frame of the pair: the suite's methods work about the rounded centroid.
Transform expectedOf(const std::string& method, const Pair& pair) {
  const Eigen::Vector3d origin = centroid(pair.target).array().round();
  const Points target = near(pair.target, origin);
  const Points source = near(pair.source, origin);
  const Points filtered = voxelGrid(target, pair.leaf);
  const Points sampled = subsample(voxelGrid(source, pair.leaf), 0.7, 1);
  Transform T;
  if (method == "icp_pcl") {
    pcl::IterativeClosestPoint<pcl::PointXYZ, pcl::PointXYZ> icp;
    T = plainPcl(icp, filtered, sampled);
  } else if (method == "gicp_pcl") {
    pcl::GeneralizedIterativeClosestPoint<pcl::PointXYZ, pcl::PointXYZ> gicp;
    T = plainPcl(gicp, filtered, sampled);
  } else {
    pcl::NormalDistributionsTransform<pcl::PointXYZ, pcl::PointXYZ> ndt;
    ndt.setResolution(static_cast<float>(pair.leaf));
    T = plainPcl(ndt, target, source);
  }
  return inLocalFrame(T, -origin);
}

/// A method with the parameters of a file of the suite.
std::unique_ptr<Registration> ofTheFile(const std::string& name, double leaf) {
  const MethodParameters file(std::string(PCRB_SOURCE_DIR) + "/../launch/config/methods/" + name +
                              ".yaml");
  return makeRegistration(file.method().empty() ? name : file.method(), file.of("mine", leaf));
}

RegistrationResult answerOf(const std::string& name, const Pair& pair) {
  const auto method = ofTheFile(name, pair.leaf);
  method->setTarget(shared(pair.target));
  return method->align(pair.source, Transform::Identity());
}

/// Problems of the shared data's three sequences, every `step`-th.
void forRealPairs(std::size_t step,
                  const std::function<void(const std::string&, const Pair&, const PointCloud&,
                                           const Transform&)>& body) {
  const std::string root = pcrb_test::sharedData() + "/benchmark";
  for (const SequenceFiles& files : selectProblemFiles(root, {"all"}, {Kind::kLocal})) {
    const double leaf = loadDataset(root, files.data_set).voxel_leaf;
    const auto problems = readProblemFile(files.problem_file);
    for (std::size_t i = 0; i < problems.size(); i += step) {
      const DatasetCloud target = readPcd(files.cloud_folder + "/" + problems[i].target);
      const Eigen::Vector3d origin = chooseLocalOrigin(target);
      const PointCloud source =
          makeLocal(readPcd(files.cloud_folder + "/" + problems[i].source), origin);
      const Transform P = inLocalFrame(requireRigid(problems[i].perturbation), origin);
      body(files.sequence, {makeLocal(target, origin), transformed(source, P), leaf}, source, P);
    }
  }
}

class PlainPcl : public ::testing::TestWithParam<std::string> {
 protected:
  static void expectPclsAnswer(const Pair& pair) {
    const Transform expected = expectedOf(GetParam(), pair);
    const RegistrationResult result = answerOf(GetParam(), pair);
    EXPECT_LT((result.T_target_source.matrix() - expected.matrix()).norm(),
              2e-4);  // of float, far from the origin
    if (GetParam() == "ndt_pcl") {
      EXPECT_EQ(result.iterations, 1);
    }
  }
};

INSTANTIATE_TEST_SUITE_P(All, PlainPcl, ::testing::Values("icp_pcl", "gicp_pcl", "ndt_pcl"),
                         [](const auto& method) { return method.param; });

TEST_P(PlainPcl, IsPclWithThePapersNumbersOnGeneratedPairs) {
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    Random random(seed);
    const Transform P = pcrb_test::randomMotion(random, 0.2, 0.5);
    // The hall is too thin for NDT's cells to be as small as a leaf.
    const double leaf = GetParam() == "ndt_pcl" ? 1.0 : 0.2;
    expectPclsAnswer({hall(seed), transformed(hall(seed + 10), P), leaf});
  }
}

TEST_P(PlainPcl, IsPclWithThePapersNumbersOnRealPairs) {
  PCRB_REQUIRE_SHARED_DATA();
  forRealPairs(40, [](const std::string&, const Pair& pair, const PointCloud&, const Transform&) {
    expectPclsAnswer(pair);
  });
}

/// Median errors by sequence.
std::map<std::string, double> mediansOf(const std::string& name) {
  std::map<std::string, std::vector<double>> errors;
  forRealPairs(30, [&](const std::string& sequence, const Pair& pair, const PointCloud& source,
                       const Transform& P) {
    const Transform reply = answerOf(name, pair).T_target_source;
    errors[sequence].push_back(Metric(source).evaluate(reply * P).error);
  });
  std::map<std::string, double> medians;
  for (const auto& [sequence, values] : errors) medians[sequence] = describe(values).median;
  return medians;
}

TEST(Baselines, PclsNdtIsAsGoodAsDoingNothing) {
  PCRB_REQUIRE_SHARED_DATA();
  const auto pcl = mediansOf("ndt_pcl");
  for (const auto& [sequence, median] : mediansOf("do_nothing")) {
    EXPECT_NEAR(pcl.at(sequence), median, 0.25 * median) << sequence;
  }
}

}  // namespace
}  // namespace pcrb
