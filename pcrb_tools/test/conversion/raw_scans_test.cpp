#include "conversion/raw_scans.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "pcrb_core/error.hpp"
#include "support/expect_error.hpp"
#include "support/log_folder.hpp"
#include "support/png_writer.hpp"
#include "support/shared_data.hpp"

namespace pcrb_tools {
namespace {

TEST(DepthPng, PixelsHaveTheUnitsOfTheImage) {
  const DepthPng png = decodeDepthPng(pcrb_test::makePng(2, 2, {0, 5000, 10001, 65535}), "a.png");
  const auto scan = pcrb::depthToScan(png.view(5000.0), {1.0, 1.0, 0.0, 0.0}, "a.png");
  ASSERT_EQ(scan.points.size(), 3u);
  EXPECT_EQ(scan.points[0], Eigen::Vector3d(1.0, 0.0, 1.0));
  EXPECT_EQ(scan.points[1].z(), 10001 / 5000.0);
  EXPECT_EQ(scan.points[2].z(), 65535 / 5000.0);
}

TEST(DepthPng, AnotherKindOfPngIsRefused) {
  PCRB_EXPECT_ERROR(pcrb::InvalidFile, decodeDepthPng(pcrb_test::makePng(1, 1, {7}, 8), "a.png"),
                    "a.png: no depth image: found another kind of PNG");
}

TEST(DepthPng, ACutOrDamagedFileIsRefused) {
  std::string png = pcrb_test::makePng(64, 64, std::vector<std::uint16_t>(4096, 4321));
  PCRB_EXPECT_ERROR(pcrb::InvalidFile, decodeDepthPng(png.substr(0, png.size() / 2), "a.png"),
                    "a.png: no depth image: ");
  PCRB_EXPECT_ERROR(pcrb::InvalidFile, decodeDepthPng("", "a.png"), "the file ends early");
  PCRB_EXPECT_ERROR(pcrb::InvalidFile, decodeDepthPng("<html></html>", "a.png"), "a.png");
  png[png.size() / 2] = static_cast<char>(png[png.size() / 2] ^ 0x55);
  PCRB_EXPECT_ERROR(pcrb::InvalidFile, decodeDepthPng(png, "a.png"), "a.png: no depth image: ");
}

TEST(DepthPng, AHeaderThatClaimsAHugeImageIsRefused) {
  std::string png = pcrb_test::makePng(1, 1, {7});
  png[16] = '\x7f';  // the width's first byte; the checksum is wrong too, whichever comes first
  PCRB_EXPECT_ERROR(pcrb::InvalidFile, decodeDepthPng(png, "a.png"), "a.png: no depth image: ");
}

TEST(DepthPng, AnImageThatUnfoldsToFarMoreThanItsBytesIsRefused) {
  const std::vector<std::uint16_t> pixels(3000 * 3000 / 4 * 4, 1000);
  const std::string bomb = pcrb_test::makePng(3000, 3000, pixels);
  ASSERT_LT(bomb.size(), 60000u);
  PCRB_EXPECT_ERROR(pcrb::InvalidFile, decodeDepthPng(bomb, "a.png"), "found 9000000 pixels in");
  const std::string flat = pcrb_test::makePng(1024, 1024, std::vector<std::uint16_t>(1 << 20, 7));
  EXPECT_EQ(decodeDepthPng(flat, "a.png").pixels.size(), std::size_t{1} << 20);
}

TEST(DepthPng, GammaChangesNoDepth) {
  std::string png = pcrb_test::makePng(2, 1, {1000, 40000});
  const std::string gamma("\0\0\0\4gAMA\0\0\xb1\x8f\x0b\xfc\x61\x05", 16);
  png.insert(33, gamma);  // behind the header
  EXPECT_EQ(decodeDepthPng(png, "a.png").pixels, (std::vector<std::uint16_t>{1000, 40000}));
}

TEST(DepthPng, RealImagesHaveDepthsOfARoom) {
  PCRB_REQUIRE_SHARED_DATA();
  for (const char* name : {"1_depth.png", "2_depth.png"}) {
    const std::string path = pcrb_test::sharedData() + "/tum/" + name;
    const DepthPng png = decodeDepthPng(pcrb_test::readFile(path), path);
    EXPECT_EQ(png.width, 640u);
    EXPECT_EQ(png.height, 480u);
    const auto scan = pcrb::depthToScan(png.view(5000.0), {}, path);
    EXPECT_EQ(scan.counts.read, 307200u);
    EXPECT_GT(scan.points.size(), 100000u);
    for (const auto& point : scan.points) ASSERT_LT(point.z(), 65535 / 5000.0);
  }
}

}  // namespace
}  // namespace pcrb_tools
