#include "pcrb_core/datasets/pose_file.hpp"

#include <gtest/gtest.h>

#include "pcrb_core/error.hpp"
#include "support/expect_error.hpp"

namespace pcrb {
namespace {

constexpr Stamp kFirst = 1403636579763555584;  // ns

/// A quarter turn about z at (1, 2, 3).
void expectQuarterTurn(const Transform& T) {
  EXPECT_LT((T.translation() - Eigen::Vector3d(1, 2, 3)).norm(), 1e-12);
  EXPECT_LT((T.linear() * Eigen::Vector3d::UnitX() - Eigen::Vector3d::UnitY()).norm(), 1e-7);
}

PoseFile parse(const std::string& text) { return parsePoseFile(text, "poses"); }

const std::string kQuarter = "0.70710678118654752";
const std::string kMatrix = "0 -1 0 1 1 0 0 2 0 0 1 3";

TEST(PoseFile, ReadsTumsFormat) {
  const PoseFile file =
      parse("# a comment\n1403636579.763555584 1 2 3 0 0 " + kQuarter + " " + kQuarter + "\n");
  EXPECT_EQ(file.format, PoseFormat::kTum);
  ASSERT_EQ(file.poses.size(), 1u);
  EXPECT_EQ(file.poses[0].stamp, kFirst);
  expectQuarterTurn(file.poses[0].T_world_body);
  EXPECT_TRUE(file.notes.empty());
}

TEST(PoseFile, TakesTimestampsInNanosecondsForWhatTheyAreAndSaysSo) {
  for (const auto& [text, unit] : {std::pair("1403636579763555584", "nanoseconds"),
                                   std::pair("1403636579763555.584", "microseconds"),
                                   std::pair("1403636579763.555584", "milliseconds"),
                                   std::pair("1.403636579763555584e18", "nanoseconds")}) {
    const PoseFile file = parse(std::string(text) + " 1 2 3 0 0 0 1\n");
    EXPECT_EQ(file.poses.at(0).stamp, kFirst) << text;
    ASSERT_EQ(file.notes.size(), 1u);
    EXPECT_NE(file.notes[0].find(unit), std::string::npos) << file.notes[0];
  }
}

TEST(PoseFile, SaysThatItTakesCommasForEurocsOrderWhereTimestampsAreSeconds) {
  const std::string row = "1403636579.763555584,1,2,3," + kQuarter + ",0,0," + kQuarter + "\n";
  const PoseFile euroc = parse(row);
  expectQuarterTurn(euroc.poses.at(0).T_world_body);
  ASSERT_EQ(euroc.notes.size(), 1u);
  EXPECT_NE(euroc.notes[0].find("w first"), std::string::npos) << euroc.notes[0];
  const std::string w_last = "1403636579.763555584,1,2,3,0,0," + kQuarter + "," + kQuarter + "\n";
  const PoseFile tum = parsePoseFile(w_last, "poses", PoseFormat::kTum);
  expectQuarterTurn(tum.poses.at(0).T_world_body);
  EXPECT_TRUE(tum.notes.empty());
}

TEST(PoseFile, SuspectsThatWIsFirstWhereARobotWouldRollOver) {
  const PoseFile w_first = parse("1.5 0 0 0 1 0 0 0\n2.5 1 2 3 0.92388 0 0.01 0.38268\n");
  ASSERT_EQ(w_first.notes.size(), 1u);
  EXPECT_NE(w_first.notes[0].find("is w first in the quaternions?"), std::string::npos);
  for (const char* rows : {"1.5 0 0 0 0 0 0 1\n2.5 1 2 3 0 0.01 0.38268 0.92388\n",
                           "1.5 0 0 0 -0.5 0.5 -0.5 0.5\n2.5 0 0 0 0.7071068 0 0 0.7071068\n"}) {
    EXPECT_TRUE(parse(rows).notes.empty()) << rows << "a robot that drives, or an optical frame";
  }
}

TEST(PoseFile, NamesSemicolonsAndDecimalCommas) {
  PCRB_EXPECT_ERROR(InvalidFile, parse("1.5;1;2;3;0;0;0;1\n"), "separated by blanks or commas");
  PCRB_EXPECT_ERROR(InvalidFile, parse("timestamp;x;y;z\n"), "separated by blanks or commas");
  PCRB_EXPECT_ERROR(InvalidFile, parse("1,5 1,25 2,5 3,5 0,0 0,0 0,0 1,0\n"),
                    "found '5 1', expected a number between commas, with a decimal point");
}

TEST(PoseFile, ReadsKittisFormatWithAndWithoutNumbersAndAFourthRow) {
  for (const std::string& row : {kMatrix, "0 " + kMatrix, kMatrix + " 0 0 0 1"}) {
    const PoseFile file = parse(row + "\n");
    EXPECT_EQ(file.format, PoseFormat::kKitti);
    EXPECT_EQ(file.key, PoseKey::kIndex);
    ASSERT_EQ(file.poses.size(), 1u);
    EXPECT_EQ(file.poses[0].index, 0u);
    expectQuarterTurn(file.poses[0].T_world_body);
  }
  const PoseFile stamped = parse("1403636579.763555584 " + kMatrix + "\n");
  EXPECT_EQ(stamped.key, PoseKey::kStamp);
  EXPECT_EQ(stamped.poses.at(0).stamp, kFirst);
  const PoseFile numbered = parse("7 " + kMatrix + "\n12 " + kMatrix + "\n");
  EXPECT_EQ(numbered.poses.at(1).index, 12u);
}

TEST(PoseFile, ReadsEurocsFormatWithItsRealHeaderAndWithoutOne) {
  const std::string row = "1403636579763555584, 1, 2, 3, " + kQuarter + ", 0, 0, " + kQuarter;
  const std::string header =
      "#timestamp, p_RS_R_x [m], p_RS_R_y [m], p_RS_R_z [m], q_RS_w [], q_RS_x [], q_RS_y [], "
      "q_RS_z [], v_RS_R_x [m s^-1]\n";
  const PoseFile with_names = parse(header + row + ", 0.5\n");
  EXPECT_EQ(with_names.format, PoseFormat::kCsv);
  const PoseFile without = parse(row + "\n");
  EXPECT_EQ(without.format, PoseFormat::kEuroc);
  for (const PoseFile& file : {with_names, without}) {
    EXPECT_EQ(file.key, PoseKey::kStamp);
    ASSERT_EQ(file.poses.size(), 1u);
    EXPECT_EQ(file.poses[0].stamp, kFirst);
    expectQuarterTurn(file.poses[0].T_world_body);
  }
}

TEST(PoseFile, ReadsKaistsFormat) {
  const PoseFile file = parse("1403636579763555584,0,-1,0,1,1,0,0,2,0,0,1,3\n");
  EXPECT_EQ(file.format, PoseFormat::kKaist);
  EXPECT_EQ(file.poses.at(0).stamp, kFirst);
  expectQuarterTurn(file.poses[0].T_world_body);
}

TEST(PoseFile, Reads3dMatchsLogOfPosesAndRefusesOneOfPairs) {
  const std::string matrix = "0 -1 0 1\n1 0 0 2\n0 0 1 3\n0 0 0 1\n";
  const PoseFile file = parse("0 0 2\n" + matrix + "1 1 2\n" + matrix);
  EXPECT_EQ(file.format, PoseFormat::kLog);
  EXPECT_EQ(file.key, PoseKey::kIndex);
  ASSERT_EQ(file.poses.size(), 2u);
  EXPECT_EQ(file.poses[1].index, 1u);
  expectQuarterTurn(file.poses[1].T_world_body);
  PCRB_EXPECT_ERROR(InvalidFile, parse("0 1 60\n" + matrix), "the motion between two scans");
  PCRB_EXPECT_ERROR(InvalidFile, parse("0 0 1\n0 -1 0 1\n"), "poses:2: found the end of the file");
}

TEST(PoseFile, FindsNamedColumnsInAnyOrderCaseAndSpelling) {
  const std::string q = kQuarter + "," + kQuarter;
  for (const std::string& text :
       {"timestamp,x,y,z,qx,qy,qz,qw\n1403636579.763555584,1,2,3,0,0," + q,
        "QW, QZ, QY, QX, Z, Y, X, Time\n" + q + ",0,0,3,2,1,1403636579.763555584",
        "%time,field.header.seq,field.header.stamp,field.pose.pose.position.x,"
        "field.pose.pose.position.y,field.pose.pose.position.z,field.pose.pose.orientation.x,"
        "field.pose.pose.orientation.y,field.pose.pose.orientation.z,"
        "field.pose.pose.orientation.w\n1403636579763555584,4,1403636579763555584,1,2,3,0,0," +
            q,
        std::string("timestamp [ns],x [m],y [m],z [m],roll [deg],pitch [deg],yaw [deg]\n"
                    "1403636579763555584,1,2,3,0,0,90"),
        std::string("secs,nsecs,tx,ty,tz,roll,pitch,yaw\n"
                    "1403636579,763555584,1,2,3,0,0,1.5707963267948966"),
        std::string("poseId, timestamp, T00, T01, T02, T03, T10, T11, T12, T13, T20, T21, T22, "
                    "T23, T30, T31, T32, T33\n0, 1403636579.763555584, 0, -1, 0, 1, 1, 0, 0, 2, "
                    "0, 0, 1, 3, 0, 0, 0, 1")}) {
    const PoseFile file = parse(text + "\n");
    EXPECT_EQ(file.format, PoseFormat::kCsv);
    ASSERT_EQ(file.poses.size(), 1u) << text;
    EXPECT_EQ(file.poses[0].stamp, kFirst) << text;
    expectQuarterTurn(file.poses[0].T_world_body);
  }
}

TEST(PoseFile, TiesPosesToFilesByTheirNames) {
  const PoseFile file = parse("file,x,y,z,yaw_deg,pitch_deg,roll_deg\na/scan7.ply,1,2,3,90,0,0\n");
  EXPECT_EQ(file.key, PoseKey::kName);
  EXPECT_EQ(file.poses.at(0).name, "a/scan7.ply");
  expectQuarterTurn(file.poses[0].T_world_body);
}

TEST(PoseFile, SaysWhatIsMissingOrWrong) {
  PCRB_EXPECT_ERROR(InvalidFile, parse("timestamp,x,y,qx,qy,qz,qw\n1,1,2,0,0,0,1\n"),
                    "found the columns timestamp, x, y, qx");
  PCRB_EXPECT_ERROR(InvalidFile, parse("x,y,z,qx,qy,qz,qw\n1,2,3,0,0,0,1\n"),
                    "no column timestamp, frame or file");
  PCRB_EXPECT_ERROR(InvalidFile, parse("1 2 3 4 5\n"), "'1 2 3 4 5' (5 fields)");
  PCRB_EXPECT_ERROR(InvalidFile, parse("1 1 2 3 0 0 0 1\n2 1 2 3 0 0 1\n"),
                    "poses:2: found '2 1 2 3 0 0 1' (7 fields), expected timestamp tx ty tz");
  PCRB_EXPECT_ERROR(InvalidFile, parse("1 1 2 3 0 0 0 2\n"), "a quaternion of norm 2");
  PCRB_EXPECT_ERROR(InvalidFile, parse("1 1 2 three 0 0 0 1\n"), "poses:1: found 'three'");
  PCRB_EXPECT_ERROR(InvalidFile, parse("1 0 0 1 0 2 0 2 0 0 1 3\n"), "expected a rotation");
  PCRB_EXPECT_ERROR(InvalidFile, parse("# nothing\n"), "found no pose");
  PCRB_EXPECT_ERROR(InvalidFile, parse("<html>"), "an HTML page");
  PCRB_EXPECT_ERROR(InvalidFile, parse(kMatrix + "\n").trajectory("poses"),
                    "poses without timestamps (kitti)");
}

TEST(PoseFile, TheLastOfTwoPosesOfAStampCounts) {
  const Trajectory poses = parse("5 1 0 0 0 0 0 1\n5 2 0 0 0 0 0 1\n").trajectory("poses");
  EXPECT_EQ(poses.size(), 1u);
  EXPECT_EQ(poses.duplicates(), 1u);
  EXPECT_EQ(poses.nearest(0).T_world_body.translation().x(), 2.0);
}

TEST(PoseFile, CountsThePosesThatALaterOneReplacesInEveryFormat) {
  const std::string block = "1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n";
  for (const std::string& text :
       {std::string("5 1 0 0 0 0 0 1\n5.0 2 0 0 0 0 0 1\n"),
        "7 " + kMatrix + "\n7 " + kMatrix + "\n",
        std::string("1403636579763555584,1,2,3,1,0,0,0\n1403636579763555584,1,2,4,1,0,0,0\n"),
        "3 3 9\n" + block + "3 3 9\n" + block,
        std::string("file,x,y,z,roll,pitch,yaw\na,1,2,3,0,0,0\na,1,2,4,0,0,0\n")}) {
    EXPECT_EQ(parse(text).duplicates(), 1u) << text;
  }
  EXPECT_EQ(parse(kMatrix + "\n" + kMatrix + "\n").duplicates(), 0u);
}

TEST(PoseFile, TimestampsMayBeScientific) {
  const auto stamps = [](const std::string& text) {
    std::vector<Stamp> found;
    for (const FilePose& pose : parse(text).poses) found.push_back(pose.stamp);
    return found;
  };
  EXPECT_EQ(stamps("1.403636579763555584e+09 1 2 3 0 0 0 1\n"), std::vector<Stamp>{kFirst});
  EXPECT_EQ(stamps("1.403636579763555584e+18,1,2,3,1,0,0,0\n"), std::vector<Stamp>{kFirst});
  EXPECT_EQ(stamps("timestamp [ns],x,y,z,qx,qy,qz,qw\n1.403636579763555584e+18,1,2,3,0,0,0,1\n"),
            std::vector<Stamp>{kFirst});
  EXPECT_EQ(stamps("1.403636579763555584e9 " + kMatrix + "\n"), std::vector<Stamp>{kFirst});
}

}  // namespace
}  // namespace pcrb
