#include <gtest/gtest.h>

#include <filesystem>
#include <sstream>

#include "pcrb_core/datasets/eth.hpp"
#include "pcrb_core/error.hpp"
#include "pcrb_core/io/number.hpp"
#include "pcrb_core/io/pcd.hpp"
#include "preparation/preparation_tools.hpp"
#include "support/expect_error.hpp"
#include "support/log_folder.hpp"
#include "support/temporary_folder.hpp"

namespace pcrb_tools {
namespace {

const std::string kHeader =
    "reading, reference, iT00, iT01, iT02, iT03, iT10, iT11, iT12, iT13, iT20, iT21, iT22, iT23, "
    "iT30, iT31, iT32, iT33\n";

std::string rowOf(const std::string& reading, const std::string& reference,
                  const pcrb::Transform& T) {
  std::string row = reading + ", " + reference;
  for (int i = 0; i != 16; ++i) {
    row += ", ";
    pcrb::appendShortest(row, T.matrix()(i / 4, i % 4));
  }
  return row + "\n";
}

/// Where scan `i` was taken.
pcrb::Transform scannerAt(int i) {
  return pcrb::Transform(Eigen::Translation3d(2.0 * i, 1, 0.5) *
                         Eigen::AngleAxisd(0.5 * i, Eigen::Vector3d::UnitZ()));
}

class ProtocolImportTest : public ::testing::Test {
 protected:
  ProtocolImportTest() {
    for (int i = 0; i != 3; ++i) {
      pcrb::DatasetCloud cloud;
      for (int p = 0; p != 50; ++p) cloud.points.emplace_back(p, i == 2 && p < 25 ? 9 : 0, 0);
      cloud.viewpoint = scannerAt(i);
      std::filesystem::create_directories(folder_.file("root/eth/apartment"));
      pcrb::writePcd(folder_.file("root/eth/apartment/PointCloud" + std::to_string(i) + ".pcd"),
                     cloud);
    }
    options_.protocol = folder_.file("apartment_protocol.csv");
    options_.folder = folder_.file("root/eth/apartment");
    options_.output = folder_.file("apartment_global.txt");
  }

  std::vector<pcrb::Problem> import(const std::string& text) {
    pcrb_test::writeFile(options_.protocol, text);
    std::ostringstream out;
    runProtocolImport(options_, out);
    return pcrb::readProblemFile(options_.output);
  }

  pcrb_test::TemporaryFolder folder_;
  ProtocolOptions options_;
};

TEST_F(ProtocolImportTest, APerturbationPutsTheSourceWhereTheProtocolBegins) {
  const pcrb::Transform error(Eigen::Translation3d(0.1, 0.2, 0) *
                              Eigen::AngleAxisd(0.1, Eigen::Vector3d::UnitX()));
  const pcrb::Transform true_motion = scannerAt(1).inverse() * scannerAt(2);
  const auto problems =
      import(kHeader + rowOf("Hokuyo_2.csv", "Hokuyo_1.csv", error * true_motion) +
             rowOf("Hokuyo_0.csv", "Hokuyo_1.csv", scannerAt(1).inverse() * scannerAt(0)) +
             rowOf("Hokuyo_2.csv", "Hokuyo_1.csv", error * true_motion));
  ASSERT_EQ(problems.size(), 2u);  // the third is the first again
  EXPECT_EQ(problems[0].source, "PointCloud2.pcd");
  EXPECT_EQ(problems[0].target, "PointCloud1.pcd");
  EXPECT_EQ(problems[0].overlap, 0.5);
  // In the reference's frame the error is what the protocol added.
  const pcrb::Transform P = pcrb::requireRigid(problems[0].perturbation);
  EXPECT_LT(((scannerAt(1).inverse() * P * scannerAt(1)).matrix() - error.matrix()).norm(), 1e-9);
  // An exact initial pose leaves nothing to do.
  EXPECT_LT(
      (pcrb::requireRigid(problems[1].perturbation).matrix() - Eigen::Matrix4d::Identity()).norm(),
      1e-9);
  EXPECT_NE(problems[0].id, problems[1].id);
}

TEST_F(ProtocolImportTest, ScansInTheWorldsFrameAreMovedByTheInitialTransformItself) {
  const pcrb::Transform T(Eigen::Translation3d(0.5, 0, 0));
  const auto problems = import(kHeader + rowOf("PointCloud0.csv", "PointCloud1.csv", T));
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(problems[0].perturbation, T.matrix().topRows<3>());
  EXPECT_EQ(problems[0].overlap, 1.0);
}

TEST_F(ProtocolImportTest, ColumnsMayBeCalledAsTheirAuthorsPageSays) {
  std::string header = kHeader;
  header.replace(0, std::string("reading, reference").size(), "reference_name, reading_name");
  const auto problems =
      import(header + rowOf("Hokuyo_1.csv", "Hokuyo_2.csv", pcrb::Transform::Identity()));
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(problems[0].source, "PointCloud2.pcd");
  EXPECT_EQ(problems[0].target, "PointCloud1.pcd");
}

TEST_F(ProtocolImportTest, SaysWhatIsWrong) {
  const pcrb::Transform T = pcrb::Transform::Identity();
  PCRB_EXPECT_ERROR(pcrb::Error, import(kHeader + rowOf("Hokuyo_7.csv", "Hokuyo_1.csv", T)),
                    "PointCloud7.pcd");
  PCRB_EXPECT_ERROR(pcrb::InvalidFile, import(kHeader + rowOf("Hokuyo_0.csv", "scan.csv", T)),
                    "apartment_protocol.csv:2: found 'scan.csv', expected a scan");
  PCRB_EXPECT_ERROR(pcrb::InvalidFile,
                    import(kHeader + rowOf("Hokuyo_0.csv", "PointCloud1.csv", T)),
                    "found scans in two frames");
  PCRB_EXPECT_ERROR(pcrb::InvalidFile, import("reading, reference\nHokuyo_0.csv, Hokuyo_1.csv\n"),
                    "found the columns reading, reference, expected columns reading");
  pcrb::DatasetCloud cloud;
  cloud.points.emplace_back(0, 0, 0);
  pcrb::writePcd(folder_.file("root/eth/apartment/PointCloud0.pcd"), cloud);
  PCRB_EXPECT_ERROR(pcrb::InvalidFile, import(kHeader + rowOf("Hokuyo_0.csv", "Hokuyo_1.csv", T)),
                    "PointCloud0.pcd: found no VIEWPOINT");
}

}  // namespace
}  // namespace pcrb_tools
