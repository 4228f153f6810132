#include <gtest/gtest.h>

#include <algorithm>

#include "pcrb_core/registration/registry.hpp"
#include "support/scenes.hpp"

namespace pcrb {
namespace {

std::string refusalOf(const std::string& path) {
  try {
    loadRegistrationLibrary(path);
  } catch (const InvalidParameter& error) {
    return error.what();
  }
  return "no error";
}

TEST(RegistrationLibrary, MakesAUsersMethodKnownByItsName) {
  const std::vector<std::string> expected{"my_method"};
  EXPECT_THROW(makeRegistration("my_method", {}), InvalidParameter);
  EXPECT_EQ(loadRegistrationLibrary(PCRB_TEST_MY_METHOD), expected);
  EXPECT_EQ(loadRegistrationLibrary(PCRB_TEST_MY_METHOD), expected) << "a second time";
  const auto names = registrationMethods();
  EXPECT_EQ(std::count(names.begin(), names.end(), "my_method"), 1);

  const auto method = makeRegistration("my_method", {{"lift", "0.5"}});
  const Transform P(Eigen::Translation3d(1.0, 2.0, 3.0));
  method->setTarget(pcrb_test::shared(pcrb_test::hall(1)));
  const auto result =
      method->align(pcrb_test::transformed(pcrb_test::hall(1), P), Transform::Identity());
  EXPECT_LT((result.T_target_source.translation() - Eigen::Vector3d(-1.0, -2.0, -2.5)).norm(),
            1e-5);
  EXPECT_GT(result.solver_time, 0.0);
}

TEST(RegistrationLibrary, HasItsParametersAndCloudsCheckedLikeAnyMethod) {
  loadRegistrationLibrary(PCRB_TEST_MY_METHOD);
  EXPECT_THROW(makeRegistration("my_method", {{"lift", "11"}}), InvalidParameter);
  EXPECT_THROW(makeRegistration("my_method", {{"lfit", "1"}}), InvalidParameter);
  const auto method = makeRegistration("my_method", {});
  EXPECT_THROW(method->align(pcrb_test::hall(1), Transform::Identity()), InvalidProblem);
  EXPECT_THROW(method->setTarget(pcrb_test::shared({})), InvalidProblem);
}

TEST(RegistrationLibrary, MayBeCompiledForANewerProcessorThanTheSuite) {
#ifdef __x86_64__
  if (__builtin_cpu_supports("avx2") == 0) GTEST_SKIP() << "this processor has no AVX2";
#endif
  loadRegistrationLibrary(PCRB_TEST_FAST_METHOD);
  const auto method = makeRegistration("fast_method", {});
  method->setTarget(pcrb_test::shared(pcrb_test::hall(1)));
  Random random(3);
  for (int i = 0; i < 20; ++i) {
    const Transform guess = pcrb_test::randomMotion(random, 2.0, 5.0);
    const auto result = method->align(pcrb_test::hall(2), guess);
    EXPECT_LT((result.T_target_source.matrix() - guess.matrix()).norm(), 1e-9);
#ifdef __x86_64__
    EXPECT_GT(result.iterations, EIGEN_MAX_ALIGN_BYTES) << "the library's flags make no difference";
#endif
  }
}

TEST(RegistrationLibrary, IsRefusedWhereItWasCompiledForAnotherInterface) {
  const std::string message = refusalOf(PCRB_TEST_OTHER_LAYOUT);
  EXPECT_NE(message.find("'other_layout' compiled for interface"), std::string::npos) << message;
  EXPECT_NE(message.find("compile it anew"), std::string::npos) << message;
  EXPECT_THROW(makeRegistration("other_layout", {}), InvalidParameter);
}

TEST(RegistrationLibrary, IsRefusedWhereItCannotBeLoaded) {
  const std::string message = refusalOf("/nowhere/libmine.so");
  EXPECT_NE(message.find("/nowhere/libmine.so"), std::string::npos) << message;
}

TEST(RegistrationLibrary, IsRefusedWhereItRegistersNothing) {
  const std::string message = refusalOf(PCRB_TEST_NO_METHOD);
  EXPECT_NE(message.find("registers no method"), std::string::npos) << message;
}

TEST(RegistrationLibrary, IsRefusedWhereANameIsTakenAndLeavesThatMethodAsItWas) {
  const std::string message = refusalOf(PCRB_TEST_TAKEN_NAME);
  EXPECT_NE(message.find("'icp'"), std::string::npos) << message;
  EXPECT_EQ(registrationDefaults("icp").count("max_iterations"), 1U);
}

}  // namespace
}  // namespace pcrb
