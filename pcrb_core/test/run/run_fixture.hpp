#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "pcrb_core/io/pcd.hpp"
#include "pcrb_core/point_cloud.hpp"
#include "pcrb_core/problem/perturbation.hpp"
#include "pcrb_core/problem/problem.hpp"
#include "pcrb_core/random.hpp"
#include "pcrb_core/run/run_plan.hpp"
#include "support/temporary_folder.hpp"

namespace pcrb {

/// Two small sequences in the common layout: `rooms/hall` (a.pcd and b.pcd, four local problems)
/// and `rooms/attic` (one global problem); the hall's clouds know their sensor's pose.
class RunFixture : public testing::Test {
 protected:
  RunFixture() {
    for (const char* sequence : {"hall", "attic"}) {
      std::filesystem::create_directories(folder_.file(std::string("data/rooms/") + sequence));
    }
    addClouds("hall", {"a.pcd", "b.pcd"}, true);
    addClouds("attic", {"c.pcd"}, false);
    writeProblems("hall_local.txt",
                  {row("10000", "a.pcd", "b.pcd", 0.1), row("10001", "b.pcd", "a.pcd", 0.2),
                   row("10002", "a.pcd", "b.pcd", 0.3), row("10003", "b.pcd", "a.pcd", 0.4)});
    writeProblems("attic_global.txt", {row("20000", "c.pcd", "c.pcd", 1.0)});
    selection_.root = folder_.file("data");
    selection_.sequences = {"hall"};
  }

  void addClouds(const std::string& sequence, const std::vector<std::string>& names, bool is_seen) {
    Random random(names.size());
    for (const std::string& name : names) {
      DatasetCloud cloud;
      for (int i = 0; i < 50; ++i) {
        cloud.points.emplace_back(4.0 * random.uniform(), 4.0 * random.uniform(),
                                  2.0 * random.uniform());
      }
      if (is_seen) cloud.viewpoint.translation() = Eigen::Vector3d(1.0, 2.0, 0.5);
      writePcd(folder_.file("data/rooms/" + sequence + "/" + name), cloud);
    }
  }

  /// A problem whose source is moved by `length` m along x.
  static Problem row(const std::string& id, const std::string& source, const std::string& target,
                     double length) {
    Problem problem{id, source, target, 0.5, {}};
    problem.perturbation =
        makePerturbation(Eigen::Vector3d::Zero(), {length, 0.0, 0.0}, Eigen::Matrix3d::Identity())
            .matrix()
            .topRows<3>();
    return problem;
  }

  void writeProblems(const std::string& name, const std::vector<Problem>& problems) const {
    writeProblemFile(folder_.file("data/rooms/" + name), problems);
  }

  Secret secret_ = Secret::fromHex("000102030405060708090a0b0c0d0e0f");
  pcrb_test::TemporaryFolder folder_;
  ProblemSelection selection_;
};

}  // namespace pcrb
