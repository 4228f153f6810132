// One suite for all registered methods: what is true of each of them.

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "pcrb_core/evaluation/covariance_consistency.hpp"
#include "pcrb_core/registration/parameters.hpp"
#include "pcrb_core/registration/registration.hpp"
#include "pcrb_core/transform.hpp"
#include "support/scenes.hpp"

namespace pcrb {
namespace {

using pcrb_test::hall;
using pcrb_test::shared;
using pcrb_test::transformed;

bool isGlobal(const std::string& method) {
  return std::set<std::string>{"fgr", "ransac", "teaser"}.count(method) > 0;
}

/// Methods that stop before they are there: that is what they are for.
bool stopsEarly(const std::string& method) {
  return std::set<std::string>{"do_nothing", "icp_pcl", "ndt_pcl"}.count(method) > 0;
}

double angleBetween(const Transform& a, const Transform& b) {
  return rotationAngle(a.linear().transpose() * b.linear());
}

/// Distance of the images of a point, m.
double distanceAt(const Eigen::Vector3d& point, const Transform& a, const Transform& b) {
  return (a * point - b * point).norm();
}

class Method : public ::testing::TestWithParam<std::string> {
 protected:
  std::unique_ptr<Registration> make(Parameters parameters = {}) const {
    // The paper's cells are too small for a basin of attraction (its NDT rarely gets anywhere).
    if (isNdt()) parameters.emplace("voxel_leaf", "1");
    if (isGlobal(GetParam())) parameters.emplace("voxel_leaf", "0.3");  // for speed
    return makeRegistration(GetParam(), parameters);
  }

  RegistrationResult align(const PointCloud& target, const PointCloud& source,
                           const Transform& guess = Transform::Identity()) const {
    const auto method = make();
    method->setTarget(shared(target));
    return method->align(source, guess);
  }

  static bool isNdt() { return GetParam().rfind("ndt", 0) == 0; }

  /// A motion that the method's start allows.
  Transform motion(std::uint64_t seed) const {
    Random random(seed);
    if (isGlobal(GetParam())) return pcrb_test::randomMotion(random, 120 * kRadiansPerDegree, 6.0);
    const bool is_narrow = isNdt();  // its cells' basin of attraction
    return pcrb_test::randomMotion(random, (is_narrow ? 2.5 : 5.0) * kRadiansPerDegree,
                                   is_narrow ? 0.2 : 0.3);
  }
};

INSTANTIATE_TEST_SUITE_P(All, Method, ::testing::ValuesIn(registrationMethods()),
                         [](const auto& method) { return method.param; });

TEST_P(Method, LeavesACloudOnItself) {
  if (GetParam() == "ndt_pcl") GTEST_SKIP() << "takes one step, wherever that leads";
  const auto result = align(hall(1), hall(1));
  EXPECT_LT(angleBetween(result.T_target_source, Transform::Identity()), 0.2 * kRadiansPerDegree);
  EXPECT_LT(result.T_target_source.translation().norm(), 0.03);
  EXPECT_TRUE(result.converged) << result.reason;
}

TEST_P(Method, RecoversKnownMotions) {
  if (stopsEarly(GetParam())) GTEST_SKIP() << "stops early";
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    const Transform P = motion(seed);
    const auto result = align(hall(1), transformed(hall(2), P));
    EXPECT_LT(angleBetween(result.T_target_source, P.inverse()), 1.5 * kRadiansPerDegree) << seed;
    EXPECT_LT(distanceAt(P.translation(), result.T_target_source, P.inverse()), 0.1) << seed;
    EXPECT_GT(result.iterations, 0);
    EXPECT_GT(result.solver_time, 0.0);
    EXPECT_EQ(result.converged, result.reason.empty()) << result.reason;
  }
}

TEST_P(Method, StartsFromTheInitialGuess) {
  if (isGlobal(GetParam())) GTEST_SKIP() << "global methods need no guess";
  if (stopsEarly(GetParam())) GTEST_SKIP() << "stops early";
  Random random(4);
  const Transform far = pcrb_test::randomMotion(random, 100 * kRadiansPerDegree, 20.0);
  const Transform guess = motion(5) * far.inverse();
  const auto result = align(hall(1), transformed(hall(2), far), guess);
  EXPECT_LT(angleBetween(result.T_target_source, far.inverse()), 1.5 * kRadiansPerDegree);
  EXPECT_LT(distanceAt(far.translation(), result.T_target_source, far.inverse()), 0.1);
}

TEST(DoNothing, RepliesTheInitialGuess) {
  Random random(3);
  const Transform guess = pcrb_test::randomMotion(random, 50 * kRadiansPerDegree, 2.0);
  const auto method = makeRegistration("do_nothing", {});
  method->setTarget(shared(hall(1)));
  const auto result = method->align(hall(2), guess);
  EXPECT_TRUE(result.T_target_source.isApprox(guess, 1e-12));
  EXPECT_TRUE(result.converged);
}

/// Answers the guess, with a known covariance.
class SureMethod : public Registration {
 protected:
  void prepareTarget(const PointCloud& /*target*/) override {}
  RegistrationResult alignSource(const PointCloud& /*source*/, const Transform& guess) override {
    RegistrationResult result;
    result.T_target_source = guess;
    result.covariance.emplace();
    for (std::size_t i = 0; i < 6; ++i) (*result.covariance)[7 * i] = 0.01;
    return result;
  }
};

TEST(Registration, GivesTheCovarianceOfThePoseInTheTargetsFrame) {
  SureMethod method;
  PointCloud target = transformed(hall(1), Transform(Eigen::Translation3d(-100.4, 0.0, 0.0)));
  const Eigen::Vector3d origin = centroid(target).array().round();  // where methods work
  method.setTarget(shared(target));
  const auto result = method.align(target, Transform::Identity());
  const double x = origin.x(), y = origin.y();
  EXPECT_NEAR((*result.covariance)[14], 0.01 + 0.01 * (x * x + y * y), 1e-9)
      << "of z, by rx and ry";
  EXPECT_NEAR((*result.covariance)[35], 0.01, 1e-12);
  EXPECT_NEAR((*result.covariance)[6 + 5], -0.01 * x, 1e-9) << "of y with rz";
}

TEST(Gicp, HasACovarianceThatFollowsTheFrame) {
  Random random(2);
  const Transform P = pcrb_test::randomMotion(random, 5 * kRadiansPerDegree, 0.3);
  const Eigen::Vector3d shift(50.0, -30.0, 10.0);
  const auto covarianceAt = [&](const Eigen::Vector3d& place) -> Eigen::Matrix<double, 6, 6> {
    const Transform moved(Eigen::Translation3d{place});
    const auto method = makeRegistration("gicp", {});
    method->setTarget(shared(transformed(hall(1), moved)));
    const auto result = method->align(transformed(hall(2), moved * P), Transform::Identity());
    const Transform truth = moved * P.inverse() * moved.inverse();
    const PoseErrorVector error = poseErrorVector(result.T_target_source, truth);
    EXPECT_TRUE(judgeCovariance(error, *result.covariance));
    return Eigen::Map<const Eigen::Matrix<double, 6, 6>>(result.covariance->data());
  };
  const auto near = covarianceAt(Eigen::Vector3d::Zero()), far = covarianceAt(shift);
  for (int i = 0; i < 6; ++i) {
    const double sigma = std::sqrt(near(i, i));
    EXPECT_TRUE(sigma > 1e-6 && sigma < 0.02) << sigma;
  }
  // Farther from the origin a rotation moves the position more: t' = t + s - R s.
  const Eigen::Vector3d lever = P.linear().transpose() * shift;
  Eigen::Matrix<double, 6, 6> J = Eigen::Matrix<double, 6, 6>::Identity();
  J.topRightCorner<3, 3>() << 0, -lever.z(), lever.y(), lever.z(), 0, -lever.x(), -lever.y(),
      lever.x(), 0;
  const Eigen::Matrix<double, 6, 6> expected = J * near * J.transpose();
  for (int i = 0; i < 6; ++i) EXPECT_NEAR(far(i, i) / expected(i, i), 1.0, 0.3) << i;
}

TEST(Ndt, DoesNotTakeAStepThatItsLineSearchCutShortForTheEnd) {
  // From this start the first step turns much and hardly moves the centroid.
  Random random(26);
  const Transform P = pcrb_test::randomMotion(random, 2.5 * kRadiansPerDegree, 0.2);
  const auto method = makeRegistration("ndt", {{"voxel_leaf", "1"}, {"filter_source", "false"}});
  method->setTarget(shared(hall(1)));
  const auto result = method->align(transformed(hall(2), P), Transform::Identity());
  // 0.2 m at the start; PCL 1.11 ends at 0.042 m.
  EXPECT_LT(distanceAt(P.translation(), result.T_target_source, P.inverse()), 0.05);
  EXPECT_GT(result.iterations, 2);
}

TEST_P(Method, IsAsAccurateFarFromTheOrigin) {
  if (stopsEarly(GetParam())) GTEST_SKIP() << "stops early";
  const Transform P = motion(2);
  const Transform shift(Eigen::Translation3d(-900.0, 1100.0, 400.0));
  PointCloud target = transformed(hall(1), shift);
  PointCloud source = transformed(hall(2), shift * P);
  target.local_origin = source.local_origin = {702000.0, 8045000.0, 100.0};
  const Transform expected = shift * P.inverse() * shift.inverse();
  const auto result = align(target, source);
  EXPECT_LT(angleBetween(result.T_target_source, expected), 1.5 * kRadiansPerDegree);
  EXPECT_LT(distanceAt(shift * P.translation(), result.T_target_source, expected), 0.1);
}

TEST_P(Method, GivesTheSameBitsAtAnyThreadCount) {
  const auto source = transformed(hall(2), motion(3));
  std::set<std::string> poses;
  for (const char* threads : {"1", "2", "5"}) {
    const auto method = make({{"threads", threads}});
    method->setTarget(shared(hall(1)));
    const Transform T = method->align(source, Transform::Identity()).T_target_source;
    const auto* bytes = reinterpret_cast<const char*>(T.data());
    poses.emplace(bytes, bytes + 16 * sizeof(double));
  }
  EXPECT_EQ(poses.size(), 1U);
}

TEST_P(Method, IsNotInfluencedByWhatItAlignedBefore) {
  const auto first = transformed(hall(2), motion(1));
  const auto second = transformed(hall(3), motion(2));
  const auto used = make();
  used->setTarget(shared(hall(4)));
  used->align(second, Transform::Identity());
  used->setTarget(shared(hall(1)));
  used->align(first, Transform::Identity());
  const Transform again = used->align(second, Transform::Identity()).T_target_source;
  const Transform fresh = align(hall(1), second).T_target_source;
  EXPECT_TRUE(again.matrix() == fresh.matrix());
}

TEST_P(Method, RefusesTooFewPoints) {
  if (GetParam() == "do_nothing") GTEST_SKIP() << "needs none";
  PointCloud few;
  few.points = {{0, 0, 0}, {5, 0, 0}};
  const auto method = make();
  EXPECT_THROW(method->setTarget(shared(few)), InvalidProblem);
  EXPECT_THROW(method->align(hall(1), Transform::Identity()), InvalidProblem) << "no target";
  EXPECT_THROW(method->setTarget(shared({})), InvalidProblem);
  EXPECT_THROW(method->setTarget(nullptr), InvalidProblem);
  method->setTarget(shared(hall(1)));
  EXPECT_THROW(method->align(few, Transform::Identity()), InvalidProblem);
  EXPECT_THROW(method->align({}, Transform::Identity()), InvalidProblem);
}

TEST_P(Method, RefusesWhatIsNotFinite) {
  PointCloud broken = hall(1);
  broken.points[17].y() = std::nanf("");
  const auto method = make();
  EXPECT_THROW(method->setTarget(shared(broken)), InvalidProblem);
  method->setTarget(shared(hall(1)));
  EXPECT_THROW(method->align(broken, Transform::Identity()), InvalidProblem);
  Transform guess = Transform::Identity();
  guess.translation().z() = std::nan("");
  EXPECT_THROW(method->align(hall(2), guess), InvalidProblem);
  guess = Transform(Eigen::UniformScaling<double>(2.0));
  EXPECT_THROW(method->align(hall(2), guess), InvalidProblem);
}

TEST_P(Method, RefusesASourceWithAnotherLocalOrigin) {
  PointCloud source = hall(2);
  source.local_origin = {100, 0, 0};
  const auto method = make();
  method->setTarget(shared(hall(1)));
  EXPECT_THROW(method->align(source, Transform::Identity()), InvalidProblem);
}

TEST_P(Method, GivesARigidPoseOrAnErrorWithoutOverlap) {
  const Transform away(Eigen::Translation3d(300.0, 0.0, 0.0));
  PointCloud other = hall(1);
  other.points.resize(4000);  // the floor alone
  try {
    const auto result = align(hall(1), transformed(other, away));
    EXPECT_NO_THROW(requireRigid(result.T_target_source.matrix().topRows<3>()));
    EXPECT_EQ(result.converged, result.reason.empty()) << result.reason;
  } catch (const RegistrationFailed& error) {
    EXPECT_STRNE(error.what(), "");
  }
}

TEST_P(Method, PutsAPlaneOnAPlaneOrSaysThatItCannot) {
  if (stopsEarly(GetParam())) GTEST_SKIP() << "stops early";
  Random random(6);
  const Transform P = pcrb_test::randomMotion(random, 2 * kRadiansPerDegree, 0.1);
  try {
    const auto result = align(pcrb_test::plane(1), transformed(pcrb_test::plane(2), P));
    const Transform left = result.T_target_source * P;
    EXPECT_NO_THROW(requireRigid(left.matrix().topRows<3>()));
    for (const double x : {-7.0, 7.0})
      EXPECT_LT(std::abs((left * Eigen::Vector3d(x, 3, 0)).z()), 0.1);
  } catch (const RegistrationFailed& error) {
    EXPECT_STRNE(error.what(), "");
  }
}

TEST_P(Method, HasItsDefaultsInItsParameterFile) {
  const std::string path =
      std::string(PCRB_SOURCE_DIR) + "/../launch/config/methods/" + GetParam() + ".yaml";
  EXPECT_EQ(MethodParameters(path).of("eth", 0.2), registrationDefaults(GetParam()));
  if (GetParam() == "do_nothing") return;  // it has no leaf
  Parameters fine = registrationDefaults(GetParam());
  fine["voxel_leaf"] = "0.1";
  EXPECT_EQ(MethodParameters(path).of("of a user's own", 0.1), fine);
  EXPECT_NO_THROW(make(fine));
}

TEST_P(Method, RefusesUnknownParameters) {
  EXPECT_THROW(make({{"voxel_laef", "0.2"}}), InvalidParameter);
  EXPECT_THROW(make({{"voxel_leaf", "-0.2"}}), InvalidParameter);
}

}  // namespace
}  // namespace pcrb
