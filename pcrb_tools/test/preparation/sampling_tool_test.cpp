#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

#include "pcrb_core/error.hpp"
#include "pcrb_core/io/pcd.hpp"
#include "pcrb_core/problem/overlap_matrix.hpp"
#include "pcrb_core/problem/pair_sampling.hpp"
#include "pcrb_core/problem/perturbation.hpp"
#include "pcrb_core/problem/problem.hpp"
#include "pcrb_core/random.hpp"
#include "preparation/preparation_tools.hpp"
#include "support/log_folder.hpp"
#include "support/temporary_folder.hpp"

namespace pcrb_tools {
namespace {

namespace fs = std::filesystem;
using pcrb::Kind;

/// Twenty clouds at UTM coordinates and a map in `<root>/planetary/p2at_met`, with overlaps.
class SamplingToolTest : public ::testing::Test {
 protected:
  SamplingToolTest() {
    fs::create_directories(folder_.file("planetary/p2at_met"));
    std::vector<std::string> names{pcrb::kMapCloud};
    for (int i = 0; i < 20; ++i) names.push_back("p2at_met_" + std::to_string(i) + ".pcd");
    pcrb::Random random(5);
    pcrb::OverlapMatrix matrix(names);
    for (std::size_t i = 0; i < names.size(); ++i) {
      pcrb::DatasetCloud cloud;
      for (int p = 0; p < 30; ++p) {
        cloud.points.emplace_back(702000.0 + random.uniform(0, 9), 8045000.0 + random.uniform(0, 9),
                                  0.0);
      }
      pcrb::writePcd(folder_.file("planetary/p2at_met/" + names[i]), cloud);
      for (std::size_t j = 0; j < names.size(); ++j) {
        if (i != j) matrix.at(i, j) = random.uniform();
      }
    }
    pcrb::writeOverlapMatrix(folder_.file("planetary/p2at_met_overlap.txt"), matrix);
    options_.folder = folder_.file("planetary/p2at_met");
  }

  std::string output(const std::string& name) const { return folder_.file("planetary/" + name); }

  std::vector<pcrb::Problem> problems(const std::string& name) const {
    return pcrb::readProblemFile(output(name));
  }

  pcrb_test::TemporaryFolder folder_;
  SamplingOptions options_;
};

TEST_F(SamplingToolTest, WritesBothListsWithinTheDataSetsBounds) {
  runSamplingTool(options_);
  const pcrb::Dataset dataset = pcrb::loadDataset(folder_.path(), "planetary");
  for (const Kind kind : {Kind::kLocal, Kind::kGlobal}) {
    const auto list = problems(kind == Kind::kLocal ? "p2at_met_local.txt" : "p2at_met_global.txt");
    EXPECT_EQ(list.size(), kind == Kind::kLocal ? 3000U : 100U);
    for (const pcrb::Problem& problem : list) {
      EXPECT_GE(problem.overlap, kind == Kind::kLocal ? 0.4 : 0.6);
      EXPECT_NE(problem.source, pcrb::kMapCloud);
      EXPECT_NE(problem.target, pcrb::kMapCloud);
      const Eigen::Vector3d center =
          centroid(pcrb::readPcd(options_.folder + "/" + problem.source));
      const pcrb::Transform P = pcrb::requireRigid(problem.perturbation);
      const double moved = (P * center - center).norm();
      EXPECT_GE(moved, dataset.bounds(kind).translation.min - 1e-8);
      EXPECT_LE(moved, dataset.bounds(kind).translation.max + 1e-8);
      if (HasFailure()) return;
    }
  }
}

TEST_F(SamplingToolTest, RecordsTheSeedAndGivesTheSameBytesForIt) {
  options_.seed = 77;
  runSamplingTool(options_);
  const std::string problems_77 = pcrb_test::readFile(output("p2at_met_local.txt"));
  const std::string side_77 = pcrb_test::readFile(output("p2at_met_local.txt.yaml"));
  EXPECT_NE(side_77.find("\n  seed: '77'\n"), std::string::npos) << side_77;
  options_.seed = 78;
  options_.threads = 2;
  runSamplingTool(options_);
  EXPECT_NE(pcrb_test::readFile(output("p2at_met_local.txt")), problems_77);
  options_.seed = 77;
  runSamplingTool(options_);
  EXPECT_EQ(pcrb_test::readFile(output("p2at_met_local.txt")), problems_77);
  EXPECT_EQ(pcrb_test::readFile(output("p2at_met_local.txt.yaml")), side_77);
}

TEST_F(SamplingToolTest, MapModePosesEveryScanAgainstTheMapInBothLists) {
  options_.map = pcrb::kMapCloud;
  runSamplingTool(options_);
  const auto local = problems("planetary_map_local.txt");
  const auto global = problems("planetary_map_global.txt");
  ASSERT_EQ(local.size(), 600U);
  ASSERT_EQ(global.size(), 20U);
  std::set<std::string> sources;
  for (std::size_t k = 0; k < global.size(); ++k) {
    EXPECT_EQ(global[k].target, pcrb::kMapCloud);
    EXPECT_EQ(global[k].source, local[30 * k].source);
    EXPECT_EQ(global[k].overlap, local[30 * k].overlap);
    sources.insert(global[k].source);
  }
  EXPECT_EQ(sources.size(), 20U);
  EXPECT_EQ(local[0].id, "2552838221000");  // the published CRC, three digits: 31 * 20 - 1 = 619
}

TEST_F(SamplingToolTest, KeepsCompleteListsAndDoesNotReplacePublishedOnes) {
  runSamplingTool(options_);
  const auto made = fs::last_write_time(output("p2at_met_local.txt"));
  runSamplingTool(options_);
  EXPECT_EQ(fs::last_write_time(output("p2at_met_local.txt")), made);
  std::ofstream(output("p2at_met_global.txt")) << "published\n";
  EXPECT_THROW(runSamplingTool(options_), pcrb::InvalidFile);
  EXPECT_EQ(pcrb_test::readFile(output("p2at_met_global.txt")), "published\n");
}

TEST_F(SamplingToolTest, NoteBoundsAreThoseOfUpstreamsNote) {
  options_.bounds = pcrb::BoundsSource::kNote;
  options_.kinds = {Kind::kLocal};
  runSamplingTool(options_);
  EXPECT_NE(pcrb_test::readFile(output("p2at_met_local.txt.yaml")).find("translation_m: '0 2'"),
            std::string::npos);
  EXPECT_FALSE(fs::exists(output("p2at_met_global.txt")));
}

TEST_F(SamplingToolTest, SaysWhatIsMissing) {
  const auto error = [&] {
    try {
      runSamplingTool(options_);
    } catch (const pcrb::Error& caught) {
      return std::string(caught.what());
    }
    return std::string("no error");
  };
  pcrb::OverlapMatrix matrix({pcrb::kMapCloud, "p2at_met_0.pcd", "p2at_met_1.pcd"});
  matrix.at(1, 2) = 0.3;
  pcrb::writeOverlapMatrix(folder_.file("planetary/p2at_met_overlap.txt"), matrix);
  EXPECT_NE(error().find("found no pair with an overlap of at least 0.4"), std::string::npos)
      << error();
  options_.map = pcrb::kMapCloud;
  EXPECT_NE(error().find("--target box_map.pcd"), std::string::npos) << error();
  options_.map = "map.pcd";
  EXPECT_NE(error().find("found no cloud 'map.pcd'"), std::string::npos) << error();
  options_.map.clear();
  pcrb::writeOverlapMatrix(folder_.file("planetary/p2at_met_overlap.txt"),
                           pcrb::OverlapMatrix({"gone.pcd"}));
  EXPECT_NE(error().find("found no cloud 'gone.pcd'"), std::string::npos) << error();
}

}  // namespace
}  // namespace pcrb_tools
