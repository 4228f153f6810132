#include "evaluation/metric_kernel.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "pcrb_core/random.hpp"

namespace pcrb {
namespace {

/// Arrays and a displacement whose sum depends on the order of summation.
struct Input {
  explicit Input(std::size_t size) : axes{3, std::vector<float>(size)}, weights(size) {
    Random random(1);
    for (auto& axis : axes) {
      for (float& value : axis) value = static_cast<float>(random.uniform(-80.0, 80.0));
    }
    for (double& weight : weights) weight = std::exp(random.uniform(-10.0, 3.0));
    for (auto& row : displacement.linear) {
      for (double& entry : row) entry = random.uniform(-1.0, 1.0);
    }
    for (double& entry : displacement.center) entry = random.uniform(-10.0, 10.0);
    for (double& entry : displacement.offset) entry = random.uniform(-1.0, 1.0);
  }

  PointArrays points() const {
    return {axes[0].data(), axes[1].data(), axes[2].data(), weights.size()};
  }

  std::vector<std::vector<float>> axes;
  std::vector<double> weights;
  Displacement displacement{};
};

/// The documented sum, one point after another.
double reference(const Input& input) {
  std::vector<double> lanes(kLanes, 0.0);
  const auto& [A, c, d] = input.displacement;
  for (std::size_t i = 0; i < input.weights.size(); ++i) {
    const double q[3] = {input.axes[0][i] - c[0], input.axes[1][i] - c[1], input.axes[2][i] - c[2]};
    double squares = 0.0;
    for (int row = 0; row < 3; ++row) {
      const double moved = A[row][0] * q[0] + A[row][1] * q[1] + A[row][2] * q[2] + d[row];
      squares += moved * moved;
    }
    lanes[i % kLanes] += std::sqrt(squares) * input.weights[i];
  }
  for (std::size_t half = kLanes / 2; half > 0; half /= 2) {
    for (std::size_t lane = 0; lane < half; ++lane) lanes[lane] += lanes[lane + half];
  }
  return lanes[0];
}

constexpr std::size_t kSize = 100 * kLanes;

TEST(MetricKernel, AddsInTheDocumentedOrder) {
  for (const std::size_t size : {std::size_t{0}, kLanes, kSize}) {
    const Input input(size);
    EXPECT_EQ(sumOfNorms(input.points(), input.weights.data(), input.displacement),
              reference(input));
  }
}

TEST(MetricKernel, HasAnInputThatTellsOrdersApart) {
  const Input input(kSize);
  double sum = 0.0;
  Input one(kLanes);
  one.displacement = input.displacement;
  for (std::size_t i = 0; i < kSize; ++i) {  // plainly from first to last
    one.weights.assign(kLanes, 0.0);
    for (std::size_t axis = 0; axis < 3; ++axis) one.axes[axis][0] = input.axes[axis][i];
    one.weights[0] = input.weights[i];
    sum += reference(one);
  }
  EXPECT_NE(sum, reference(input));
  EXPECT_NEAR(sum, reference(input), 1e-10 * sum);
}

#if defined(__x86_64__)

// By its parts: GCC 9 does not know the levels of x86-64, and GCC 12 inlines into no function for
// another processor.
__attribute__((target("avx2,fma"))) double withAvx2(const Input& input) {
  return sumOfNormsBody(input.points(), input.weights.data(), input.displacement);
}

TEST(MetricKernel, GivesTheSameBitsWithoutWideInstructions) {
  const Input input(kSize);
  EXPECT_EQ(sumOfNormsBody(input.points(), input.weights.data(), input.displacement),
            reference(input));
}

TEST(MetricKernel, GivesTheSameBitsWithAvx2) {
  if (!__builtin_cpu_supports("avx2")) GTEST_SKIP() << "no AVX2 here";
  const Input input(kSize);
  EXPECT_EQ(withAvx2(input), reference(input));
}

TEST(MetricKernel, GivesTheSameBitsWithAvx512) {
  if (!__builtin_cpu_supports("avx512f")) GTEST_SKIP() << "no AVX-512 here";
  const Input input(kSize);  // which the library has a loop of its own for
  EXPECT_EQ(sumOfNorms(input.points(), input.weights.data(), input.displacement),
            sumOfNormsBody(input.points(), input.weights.data(), input.displacement));
}

#endif

}  // namespace
}  // namespace pcrb
