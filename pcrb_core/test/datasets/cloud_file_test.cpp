#include "pcrb_core/datasets/cloud_file.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>

#include "pcrb_core/error.hpp"
#include "pcrb_core/io/memory_budget.hpp"
#include "pcrb_core/random.hpp"
#include "support/expect_error.hpp"

namespace pcrb {
namespace {

template <typename Number>
std::string bytesOf(const std::vector<Number>& numbers, bool big_endian = false) {
  std::string bytes;
  for (const Number number : numbers) {
    std::string one(sizeof(number), '\0');
    std::memcpy(one.data(), &number, sizeof(number));
    if (big_endian) std::reverse(one.begin(), one.end());
    bytes += one;
  }
  return bytes;
}

SensorScan parse(const std::string& bytes, const std::string& name,
                 const CloudFileOptions& options = {}) {
  return parseCloudFile(bytes, name, options);
}

/// (1.5, -2, 3) and (4, 5, 6).
void expectTwoPoints(const SensorScan& scan) {
  ASSERT_EQ(scan.points.size(), 2u);
  EXPECT_EQ(scan.points[0], Eigen::Vector3d(1.5, -2, 3));
  EXPECT_EQ(scan.points[1], Eigen::Vector3d(4, 5, 6));
}

std::string npy(const std::string& descr, const std::string& shape, const std::string& data,
                const std::string& fortran = "False") {
  const std::string header =
      "{'descr': " + descr + ", 'fortran_order': " + fortran + ", 'shape': " + shape + ", }\n";
  return std::string("\x93NUMPY\x01\x00", 8) + static_cast<char>(header.size()) + '\0' + header +
         data;
}

TEST(CloudFile, KnowsItsEndingsInAnyCase) {
  for (const char* name : {"a.pcd", "b.PLY", "c.bin", "d.Npy"}) EXPECT_TRUE(isCloudFileName(name));
  for (const char* name : {"a.txt", "pcd", "a.pcd.gz"}) EXPECT_FALSE(isCloudFileName(name));
}

constexpr const char* kPcd =
    "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 2\nHEIGHT 1\n"
    "VIEWPOINT 0 0 0 1 0 0 0\nPOINTS 2\nDATA ascii\n1.5 -2 3\n4 5 6\n";

TEST(CloudFile, ReadsAPcdWhileItsReaderHoldsAllMemoryOfTheProcess) {
  MemoryBudget& budget = MemoryBudget::ofProcess();
  const auto share = budget.take(budget.limit());
  expectTwoPoints(parse(kPcd, "a.pcd"));
}

TEST(CloudFile, KeepsWhatAPcdSaysOfAnIdentityViewpoint) {
  EXPECT_FALSE(parse(kPcd, "a.pcd").is_viewpoint_known);
  EXPECT_TRUE(
      parse("# VIEWPOINT is the sensor's pose\n" + std::string(kPcd), "a.pcd").is_viewpoint_known);
}

TEST(CloudFile, StampsAreFoundInNames) {
  EXPECT_EQ(stampOfFileName("1311878220.377686160.pcd"), 1311878220377686160);
  EXPECT_EQ(stampOfFileName("scan_5.000000001.ply"), 5000000001);
  EXPECT_EQ(stampOfFileName("urban05_1524185042111111111.pcd"), 1524185042111111111);
  EXPECT_FALSE(stampOfFileName("PointCloud12.pcd"));
  EXPECT_FALSE(stampOfFileName("000012.bin"));
}

TEST(CloudFile, ReadsPlyOfTextAndOfEitherByteOrderInDouble) {
  const std::string elements =
      "comment made by hand\nelement vertex 2\nproperty double x\nproperty double y\n"
      "property double z\nproperty uchar red\nelement face 1\n"
      "property list uchar int vertex_indices\nend_header\n";
  const std::string text = "ply\nformat ascii 1.0\n" + elements + "1.5 -2 3 7\n4 5 6 8\n3 0 1 1\n";
  expectTwoPoints(parse(text, "a.ply"));
  for (const bool big_endian : {false, true}) {
    const std::string data = bytesOf<double>({1.5, -2, 3}, big_endian) + '\7' +
                             bytesOf<double>({4, 5, 6}, big_endian) + "\1\3faces";
    const std::string format = big_endian ? "binary_big_endian" : "binary_little_endian";
    expectTwoPoints(parse("ply\nformat " + format + " 1.0\n" + elements + data, "a.ply"));
  }
  PCRB_EXPECT_ERROR(InvalidFile, parse("ply\nformat ascii 1.0\n" + elements + "1 2 3 7\n", "a.ply"),
                    "the end after 1 vertices");
  PCRB_EXPECT_ERROR(InvalidFile, parse("ply\nformat ascii 1.0\n" + elements + "1 2 3\n", "a.ply"),
                    "a.ply:12: found '1 2 3' (3 fields)");
  PCRB_EXPECT_ERROR(InvalidFile, parse("solid x\n", "a.ply"), "expected `ply`");
  PCRB_EXPECT_ERROR(
      InvalidFile,
      parse("ply\nformat binary_little_endian 1.0\nelement vertex 9\nproperty float x\n"
            "property float y\nproperty float z\nend_header\n1234",
            "a.ply"),
      "is the file cut?");
}

TEST(CloudFile, ReadsTheTimesOfVertices) {
  const std::string head =
      "element vertex 2\nproperty uint t\nproperty float x\nproperty float y\n"
      "property float z\nend_header\n";
  const std::string text = "ply\nformat ascii 1.0\n" + head + "0 1.5 -2 3\n50000000 4 5 6\n";
  const std::string data = bytesOf<std::uint32_t>({0}) + bytesOf<float>({1.5F, -2, 3}) +
                           bytesOf<std::uint32_t>({50'000'000}) + bytesOf<float>({4, 5, 6});
  for (const std::string& bytes : {text, "ply\nformat binary_little_endian 1.0\n" + head + data}) {
    const SensorScan scan = parse(bytes, "a.ply");
    expectTwoPoints(scan);
    ASSERT_EQ(scan.times.size(), 2u);
    EXPECT_DOUBLE_EQ(scan.times[1], 0.05);
  }
}

TEST(CloudFile, ReadsRecordsOfFloatsAndSuspectsAnotherLength) {
  const std::string kitti = bytesOf<float>({1.5F, -2, 3, 0.1F, 4, 5, 6, 0.2F});
  expectTwoPoints(parse(kitti, "000000.bin"));
  const std::string nuscenes = bytesOf<float>({1.5F, -2, 3, 0.1F, 9, 4, 5, 6, 0.2F, 9});
  CloudFileOptions five;
  five.bin_fields = 5;
  expectTwoPoints(parse(nuscenes, "000000.bin", five));
  PCRB_EXPECT_ERROR(InvalidFile, parse(nuscenes.substr(1), "000000.bin"), "found 39 bytes");
  // Doubles, of which 16 bytes are no point.
  std::vector<double> doubles(600, 12.345678);
  PCRB_EXPECT_ERROR(InvalidFile,
                    parse(
                        bytesOf(doubles) + bytesOf<float>({1e30F, 0, 0, 0}) +
                            [] {
                              std::string far;
                              for (int i = 0; i < 20; ++i) far += bytesOf<float>({1e30F, 0, 0, 0});
                              return far;
                            }(),
                        "000000.bin"),
                    "are these longer or shorter? (--bin-fields)");
  PCRB_EXPECT_ERROR(InvalidFile, parse("version https://git-lfs.github.com/spec/v1\n", "0.bin"),
                    "a Git LFS pointer");
}

/// 64 records: x, y, z, and what follows.
std::string recordsWith(const std::vector<float>& others) {
  std::string bytes;
  for (int i = 0; i != 64; ++i) {
    const auto place = static_cast<float>(i);
    bytes += bytesOf<float>({0.21F + 0.37F * place, -0.13F - 0.53F * place, 0.07F});
    for (const float other : others) bytes += bytesOf<float>({other + place});
  }
  return bytes;
}

/// A scan of 3,000 points on the ground and on walls, x and y about 0, with numbers like these.
std::string scanOf(const std::function<std::vector<float>(const Eigen::Vector3f&)>& record) {
  Random random(5);
  std::string bytes;
  for (int i = 0; i != 3000; ++i) {
    const double angle = random.uniform(0.0, 6.28);
    const double range = random.uniform(3.0, 40.0);
    const bool is_wall = random.uniform(0.0, 3.0) < 1.0;
    const double z = -1.7 + (is_wall ? random.uniform(0.0, 4.7) : random.uniform(-0.02, 0.02));
    bytes += bytesOf<float>(
        record(Eigen::Vector3d(range * std::cos(angle), range * std::sin(angle), z).cast<float>()));
  }
  return bytes;
}

TEST(CloudFile, ReadsNoRecordsOfAnotherLengthWhoseColumnsAreMixed) {
  const auto read = [](const std::string& bytes, std::size_t fields) {
    CloudFileOptions options;
    options.bin_fields = fields;
    return parse(bytes, "0.bin", options).points.size();
  };
  using Point = Eigen::Vector3f;
  const auto length3 = scanOf([](const Point& p) {
    return std::vector<float>{p.x(), p.y(), p.z()};
  });
  const auto length4 = scanOf([](const Point& p) {
    return std::vector<float>{p.x(), p.y(), p.z(), 0.01F * p.norm()};
  });
  const auto length5 = scanOf([](const Point& p) {
    return std::vector<float>{p.x(), p.y(), p.z(), 0.01F * p.norm(), 0.1F * p.x() * p.x()};
  });
  EXPECT_EQ(read(length3, 3), 3000u);
  EXPECT_EQ(read(length4, 4), 3000u);
  EXPECT_EQ(read(length5, 5), 3000u);
  PCRB_EXPECT_ERROR(InvalidFile, read(length3, 4), "try --bin-fields 3");
  PCRB_EXPECT_ERROR(InvalidFile, read(length3, 5), "try --bin-fields 3");
  PCRB_EXPECT_ERROR(InvalidFile, read(length4, 3), "try --bin-fields 4");
  PCRB_EXPECT_ERROR(InvalidFile, read(length4, 5), "try --bin-fields 4");
  PCRB_EXPECT_ERROR(InvalidFile, read(length5, 4), "try --bin-fields 5");
}

TEST(CloudFile, ReadsNoRecordsWithRingsAsShorterOnes) {
  CloudFileOptions five;
  five.bin_fields = 5;
  const std::string rings = recordsWith({0.3F, 1.0F});
  EXPECT_EQ(parse(rings, "0.bin", five).points.size(), 64u);
  PCRB_EXPECT_ERROR(InvalidFile, parse(rings, "0.bin"), "try --bin-fields 5");
  PCRB_EXPECT_ERROR(InvalidFile, parse(recordsWith({0.3F, 1.0F, 0.01F, 0.02F, 0.04F}), "0.bin"),
                    "try --bin-fields 8");
  EXPECT_EQ(parse(recordsWith({0.3F}), "0.bin").points.size(), 64u);
  EXPECT_EQ(parse(recordsWith({7.0F}), "0.bin").points.size(), 64u) << "whole intensities";
  PCRB_EXPECT_ERROR(InvalidFile, parse(recordsWith({7.0F}), "0.bin", five), "expected records");
}

TEST(CloudFile, ReadsArraysOfNumpy) {
  expectTwoPoints(
      parse(npy("'<f4'", "(2, 4)", bytesOf<float>({1.5F, -2, 3, 9, 4, 5, 6, 9})), "a.npy"));
  expectTwoPoints(
      parse(npy("'>f8'", "(2, 3)", bytesOf<double>({1.5, -2, 3, 4, 5, 6}, true)), "a.npy"));
  expectTwoPoints(
      parse(npy("'<f4'", "(2, 3)", bytesOf<float>({1.5F, 4, -2, 5, 3, 6}), "True"), "a.npy"));
  expectTwoPoints(
      parse(npy("'<f4'", "(1, 2, 3)", bytesOf<float>({1.5F, -2, 3, 4, 5, 6})), "a.npy"));
  PCRB_EXPECT_ERROR(InvalidFile, parse(npy("'<f4'", "(2, 2)", "12345678"), "a.npy"),
                    "an array of shape '(2, 2)'");
  PCRB_EXPECT_ERROR(InvalidFile, parse(npy("'<i4'", "(2, 3)", "12345678"), "a.npy"), "'<i4'");
  PCRB_EXPECT_ERROR(InvalidFile, parse(npy("'<f5'", "(1, 3)", "123456789012345"), "a.npy"),
                    "'<f5'");
  PCRB_EXPECT_ERROR(InvalidFile, parse(npy("'<f4'", "(9, 3)", "12345678"), "a.npy"),
                    "is the file cut?");
  PCRB_EXPECT_ERROR(InvalidFile, parse("no array at all", "a.npy"), "another beginning");
}

TEST(CloudFile, ReadsRecordsOfNumpyWithTheTimesOfTheirPoints) {
  const std::string record =
      bytesOf<float>({1.5F, -2, 3}) + bytesOf<std::uint32_t>({50'000'000}) + "pad.";
  const SensorScan scan = parse(
      npy("[('x', '<f4'), ('y', '<f4'), ('z', '<f4'), ('t', '<u4'), ('', '|V4')]", "(1,)", record),
      "a.npy");
  ASSERT_EQ(scan.points.size(), 1u);
  EXPECT_EQ(scan.points[0], Eigen::Vector3d(1.5, -2, 3));
  ASSERT_EQ(scan.times.size(), 1u);
  EXPECT_DOUBLE_EQ(scan.times[0], 0.05);
  PCRB_EXPECT_ERROR(InvalidFile,
                    parse(npy("[('x', '<f4'), ('y', '<f4')]", "(1,)", "12345678"), "a.npy"),
                    "found the fields x y");
}

TEST(CloudFile, ReadsPcdAndCountsWhatIsNotFinite) {
  const SensorScan scan = parse(
      "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 3\nHEIGHT 1\n"
      "VIEWPOINT 7 8 9 1 0 0 0\nPOINTS 3\nDATA ascii\n1.5 -2 3\nnan nan nan\n4 5 6\n",
      "a.pcd");
  expectTwoPoints(scan);
  EXPECT_EQ(scan.counts.read, 3u);
  EXPECT_EQ(scan.counts.non_finite, 1u);
  EXPECT_EQ(scan.viewpoint.translation(), Eigen::Vector3d(7, 8, 9));
}

TEST(CloudFile, ReadsTheTimesOfAPcd) {
  CloudFileOptions drop;
  drop.origin = OriginPoints::kDrop;
  const SensorScan scan = parse(
      "VERSION 0.7\nFIELDS x y z time\nSIZE 4 4 4 4\nTYPE F F F F\nCOUNT 1 1 1 1\nWIDTH 4\n"
      "HEIGHT 1\nPOINTS 4\nDATA ascii\n1.5 -2 3 0.25\n0 0 0 0.5\nnan 1 1 0.75\n4 5 6 1\n",
      "a.pcd", drop);
  expectTwoPoints(scan);
  EXPECT_EQ(scan.times, (std::vector<double>{0.25, 1}));
}

TEST(CloudFile, NamesWhatIsThereInPlaceOfAnyCloud) {
  const std::string zip = std::string("PK\x03\x04", 4) + std::string(60, 'x');
  for (const char* name : {"a.pcd", "a.ply", "a.bin", "a.npy"}) {
    PCRB_EXPECT_ERROR(InvalidFile, parse("<!DOCTYPE html><html></html>\n", name), "an HTML page");
    PCRB_EXPECT_ERROR(InvalidFile, parse("<?xml version=\"1.0\"?><Error>", name), "a page of XML");
    PCRB_EXPECT_ERROR(InvalidFile, parse("version https://git-lfs.github.com/spec/v1\n", name),
                      "a Git LFS pointer");
    PCRB_EXPECT_ERROR(InvalidFile, parse(zip, name), "a compressed archive");
    PCRB_EXPECT_ERROR(InvalidFile, parse("", name), name);
  }
}

}  // namespace
}  // namespace pcrb
