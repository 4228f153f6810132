#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "pcrb_core/random.hpp"
#include "pcrb_core/transform.hpp"
#include "registration/teaser_steps.hpp"

namespace pcrb {
namespace {

constexpr double kEnough = 1e9;

Graph randomGraph(Random& random, std::size_t size, double density) {
  Graph graph(size);
  for (std::size_t a = 0; a < size; ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      if (random.uniform() < density) graph.connect(a, b);
    }
  }
  return graph;
}

bool isClique(const Graph& graph, const std::vector<std::size_t>& nodes) {
  for (const std::size_t a : nodes) {
    for (const std::size_t b : nodes) {
      if (a != b && !graph.connected(a, b)) return false;
    }
  }
  return true;
}

/// Size of a maximum clique, by trying all sets of nodes.
std::size_t bruteForce(const Graph& graph) {
  std::size_t best = 0;
  for (std::uint32_t set = 0; set < (1U << graph.size()); ++set) {
    std::vector<std::size_t> nodes;
    for (std::size_t v = 0; v < graph.size(); ++v) {
      if (((set >> v) & 1U) != 0) nodes.push_back(v);
    }
    if (nodes.size() > best && isClique(graph, nodes)) best = nodes.size();
  }
  return best;
}

TEST(MaximumClique, IsAsLargeAsTheBestOfAllSets) {
  Random random(1);
  for (int trial = 0; trial < 60; ++trial) {
    const Graph graph = randomGraph(random, 13, 0.1 + 0.8 * random.uniform());
    const Clique clique = maximumClique(graph, kEnough);
    EXPECT_EQ(clique.nodes.size(), bruteForce(graph)) << trial;
    EXPECT_TRUE(isClique(graph, clique.nodes)) << trial;
    EXPECT_TRUE(clique.is_maximum);
  }
}

TEST(MaximumClique, FindsAPlantedCliqueInANoisyGraphOfSeveralWords) {
  Random random(2);
  Graph graph = randomGraph(random, 700, 0.2);
  std::vector<std::size_t> planted;
  for (std::size_t v = 3; v < 700; v += 11) planted.push_back(v);
  for (const std::size_t a : planted) {
    for (const std::size_t b : planted) {
      if (a != b) graph.connect(a, b);
    }
  }
  const Clique clique = maximumClique(graph, kEnough);
  EXPECT_EQ(clique.nodes, planted);
  EXPECT_TRUE(clique.is_maximum);
}

TEST(MaximumClique, SaysThatItIsNotProvenWhereTheWorkIsLimited) {
  Random random(3);
  const Graph graph = randomGraph(random, 300, 0.7);
  const Clique clique = maximumClique(graph, 1000.0);
  EXPECT_FALSE(clique.is_maximum);
  EXPECT_GE(clique.nodes.size(), 3U);
  EXPECT_TRUE(isClique(graph, clique.nodes));
  EXPECT_EQ(maximumClique(graph, 1000.0).nodes, clique.nodes) << "a second time";
}

TEST(MaximumClique, OfAGraphWithoutEdgesIsANodeAndOfNoGraphNothing) {
  EXPECT_EQ(maximumClique(Graph(5), kEnough).nodes.size(), 1U);
  EXPECT_TRUE(maximumClique(Graph(0), kEnough).nodes.empty());
}

TEST(EstimateNumber, HasTheLeastTruncatedCostOfAllNumbers) {
  Random random(4);
  constexpr double kBound = 0.3;
  for (int trial = 0; trial < 30; ++trial) {
    std::vector<double> values;
    for (int i = 0; i < 12; ++i) values.push_back(random.uniform(700.0, 703.0));
    const auto cost = [&](double t) {
      double sum = 0.0;
      for (const double value : values) sum += std::min((value - t) * (value - t), kBound * kBound);
      return sum;
    };
    double least = cost(700.0);
    for (double t = 700.0; t < 703.0; t += 1e-3) least = std::min(least, cost(t));
    EXPECT_LE(cost(estimateNumber(values, kBound)), least + 1e-12) << trial;
  }
}

TEST(EstimateNumber, IgnoresAMajorityOfScatteredOutliers) {
  Random random(5);
  std::vector<double> values;
  for (int i = 0; i < 20; ++i) values.push_back(4.0 + random.uniform(-0.05, 0.05));
  for (int i = 0; i < 80; ++i) values.push_back(random.uniform(-100.0, 100.0));
  EXPECT_NEAR(estimateNumber(values, 0.1), 4.0, 0.03);
}

struct RotationProblem {
  Points source, target;
  Eigen::Matrix3d R;
};

Eigen::Vector3d somePoint(Random& random) {
  const double distance = 10.0 * random.uniform();  // first: the order in an expression is open
  return distance * random.direction();
}

RotationProblem makeRotationProblem(Random& random, int inliers, int outliers, double noise) {
  RotationProblem problem;
  problem.R = random.rotation().toRotationMatrix();
  for (int i = 0; i < inliers + outliers; ++i) {
    const Eigen::Vector3d a = somePoint(random);
    const Eigen::Vector3d b =
        i < inliers ? (problem.R * a + noise * random.direction()).eval() : somePoint(random);
    problem.source.push_back(a.cast<float>());
    problem.target.push_back(b.cast<float>());
  }
  return problem;
}

TEST(EstimateRotation, IsTheLeastSquaresSolutionWhereAllResidualsAreWithinTheBound) {
  Random random(6);
  const auto problem = makeRotationProblem(random, 30, 0, 0.01);
  const auto found = estimateRotation(problem.source, problem.target, 0.5, 100, 1);
  EXPECT_EQ(found.iterations, 0);
  EXPECT_LT(rotationAngle(found.R.transpose() * problem.R), 0.005);
}

TEST(EstimateRotation, IgnoresOutliers) {
  Random random(7);
  for (int trial = 0; trial < 5; ++trial) {
    const auto problem = makeRotationProblem(random, 40, 20, 0.02);
    const auto found = estimateRotation(problem.source, problem.target, 0.1, 100, 1);
    EXPECT_LT(rotationAngle(found.R.transpose() * problem.R), 0.01) << trial;
    EXPECT_GT(found.iterations, 0);
  }
}

TEST(EstimateRotation, HasTheSameBitsAtAnyThreadCount) {
  Random random(8);
  const auto problem = makeRotationProblem(random, 210, 90, 0.02);
  const auto one = estimateRotation(problem.source, problem.target, 0.1, 100, 1);
  const auto four = estimateRotation(problem.source, problem.target, 0.1, 100, 4);
  EXPECT_TRUE(one.R == four.R);
}

}  // namespace
}  // namespace pcrb
