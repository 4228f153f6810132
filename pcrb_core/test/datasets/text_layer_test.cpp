#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

#include "pcrb_core/datasets/cloud_file.hpp"
#include "pcrb_core/datasets/eth.hpp"
#include "pcrb_core/datasets/kaist.hpp"
#include "pcrb_core/datasets/planetary.hpp"
#include "pcrb_core/datasets/pose_file.hpp"
#include "pcrb_core/datasets/tum.hpp"
#include "pcrb_core/error.hpp"
#include "pcrb_core/io/csv.hpp"
#include "pcrb_core/io/pcd.hpp"
#include "pcrb_core/problem/overlap_matrix.hpp"
#include "pcrb_core/problem/problem.hpp"

namespace pcrb {
namespace {

/// A text format: a good file of it, and what its reader makes of one, as numbers.
struct Format {
  std::string name;
  std::string text;
  std::function<std::vector<double>(const std::string&)> read;
};

std::vector<double> numbersOf(const Transform& T) {
  const Eigen::Matrix4d& matrix = T.matrix();
  return {matrix.data(), matrix.data() + matrix.size()};
}

std::vector<double> numbersOf(const std::vector<Eigen::Vector3d>& points) {
  std::vector<double> numbers;
  for (const auto& point : points) numbers.insert(numbers.end(), point.data(), point.data() + 3);
  return numbers;
}

std::vector<double> numbersOf(const Trajectory& trajectory) {
  std::vector<double> numbers{static_cast<double>(trajectory.firstStamp()),
                              static_cast<double>(trajectory.lastStamp())};
  for (const Stamp stamp : {trajectory.firstStamp(), trajectory.lastStamp()}) {
    const auto pose = numbersOf(trajectory.nearest(stamp).T_world_body);
    numbers.insert(numbers.end(), pose.begin(), pose.end());
  }
  return numbers;
}

std::vector<double> posesOf(const std::string& text) {
  std::vector<double> numbers;
  for (const FilePose& pose : parsePoseFile(text, "file").poses) {
    numbers.push_back(static_cast<double>(pose.stamp));
    const auto matrix = numbersOf(pose.T_world_body);
    numbers.insert(numbers.end(), matrix.begin(), matrix.end());
  }
  return numbers;
}

std::vector<Format> formats() {
  const std::string rows = "1, 0, 0, 1, 0, 1, 0, 2, 0, 0, 1, 3, 0, 0, 0, 1\n";
  return {
      {"problem file",
       "id source target overlap t1 t2 t3 t4 t5 t6 t7 t8 t9 t10 t11 t12\n"
       "4215528470000 a.pcd b.pcd 0.5 1 0 0 1 0 1 0 2 0 0 1 3\n",
       [](const std::string& text) {
         const auto problems = parseProblemFile(text.data(), text.data() + text.size(), "file");
         std::vector<double> numbers{problems[0].overlap};
         numbers.insert(numbers.end(), problems[0].perturbation.data(),
                        problems[0].perturbation.data() + 12);
         return numbers;
       }},
      {"overlap matrix", "overlap a.pcd b.pcd\na.pcd 1 0.5\nb.pcd 0.25 1\n",
       [](const std::string& text) {
         return parseOverlapMatrix(text.data(), text.data() + text.size(), "file").values;
       }},
      {"pcd",
       "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nWIDTH 2\nHEIGHT 1\nPOINTS 2\n"
       "DATA ascii\n1 2 3\n4 5 6\n",
       [](const std::string& text) {
         return numbersOf(parsePcd(text.data(), text.data() + text.size(), "file").points);
       }},
      {"csv", "id,error\n1,0.5\n",
       [](const std::string& text) {
         LineReader lines(text, "file");
         std::vector<double> numbers;
         for (std::vector<std::string> fields; nextCsvRow(lines, fields);) {
           numbers.push_back(static_cast<double>(fields.size()));
           numbers.push_back(static_cast<double>(fields[1].size()));
         }
         return numbers;
       }},
      {"ETH scan", "Time, x, y, z\n1.5,1,2,3\n1.5,4,5,6\n",
       [](const std::string& text) { return numbersOf(parseEthScan(text, "file").points); }},
      {"ETH poses",
       "poseId, timestamp, T00, T01, T02, T03, T10, T11, T12, T13, T20, T21, T22, T23, T30, T31, "
       "T32, T33\n0, 1.5, " +
           rows,
       [](const std::string& text) { return numbersOf(parseLeicaPoses(text, "file").at(0)); }},
      {"planetary scan", "1 2 3\n4 5 6\n",
       [](const std::string& text) { return numbersOf(parsePlanetaryScan(text, "file").points); }},
      {"planetary pose", "1 0 0 1\n0 1 0 2\n0 0 1 3\n0 0 0 1\n",
       [](const std::string& text) { return numbersOf(parsePlanetaryPose(text, "file")); }},
      {"TUM trajectory", "# t x y z qx qy qz qw\n1.5 1 2 3 0 0 0 1\n1.6 1 2 4 0 0 0 -1\n",
       [](const std::string& text) { return numbersOf(parseTrajectory(text, "file").trajectory); }},
      {"TUM images", "1311878220.25 depth/1.png\n1311878221.25 depth/2.png\n",
       [](const std::string& text) {
         std::vector<double> numbers;
         for (const auto& image : parseTumImageList(text, "file")) {
           numbers.push_back(static_cast<double>(image.stamp));
         }
         return numbers;
       }},
      {"KAIST stamps", "1524211208123456789\n1524211208223456789\n",
       [](const std::string& text) {
         std::vector<double> numbers;
         for (const Stamp stamp : parseKaistStamps(text, "file")) {
           numbers.push_back(static_cast<double>(stamp));
         }
         return numbers;
       }},
      {"KAIST calibration", "RPY: 1 2 3\nR: 1 0 0 0 1 0 0 0 1\nT: 0.5 -1 2\n",
       [](const std::string& text) { return numbersOf(parseKaistCalibration(text, "file")); }},
      {"KITTI poses", "1 0 0 1 0 1 0 2 0 0 1 3\n1 0 0 1 0 1 0 2 0 0 1 4\n", posesOf},
      {"EuRoC poses",
       "#timestamp, p_x, p_y, p_z, q_w, q_x, q_y, q_z\n1403636579763555584,1,2,3,1,0,0,0\n",
       posesOf},
      {"log of poses", "0 0 1\n1 0 0 1\n0 1 0 2\n0 0 1 3\n0 0 0 1\n", posesOf},
      {"named poses", "file, x, y, z, roll, pitch, yaw_deg\na.ply, 1, 2, 3, 0, 0, 90\n", posesOf},
      {"ETH protocol",
       "reading, reference, iT00, iT01, iT02, iT03, iT10, iT11, iT12, iT13, iT20, iT21, iT22, "
       "iT23, "
       "iT30, iT31, iT32, iT33\nHokuyo_1.csv, Hokuyo_0.csv, " +
           rows,
       [](const std::string& text) {
         return numbersOf(parseEthProtocol(text, "file").at(0).T_reference_reading);
       }},
      {"ply",
       "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
       "property float z\nend_header\n1 2 3\n",
       [](const std::string& text) {
         return numbersOf(parsePly(text, OriginPoints::kKeep, "file").points);
       }},
      {"KAIST trajectory",
       "1519102894479453000,1,0,0,5,0,1,0,6,0,0,1,7\n"
       "1519102894489453000,1,0,0,5,0,1,0,6,0,0,1,8\n",
       [](const std::string& text) { return numbersOf(parseKaistTrajectory(text, "file")); }},
  };
}

std::string replaced(const std::string& text, const std::string& what, const std::string& with) {
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool is_it = text.compare(i, what.size(), what) == 0;
    result += is_it ? with : text.substr(i, 1);
    if (is_it) i += what.size() - 1;
  }
  return result;
}

std::string inUtf16(const std::string& text) {
  std::string result;
  for (const char c : text) result += {c, '\0'};
  return result;
}

std::string inBigEndianUtf16(const std::string& text) {
  std::string result;
  for (const char c : text) result += {'\0', c};
  return result;
}

/// What harms no number, and what it makes of a file.
struct Variant {
  std::string name;
  std::function<std::string(const std::string&)> make;
};

TEST(TextLayer, ReadsEveryFormatWithWhatHarmsNoNumber) {
  const std::vector<Variant> variants{
      {"a byte order mark", [](const std::string& text) { return "\xEF\xBB\xBF" + text; }},
      {"CRLF", [](const std::string& text) { return replaced(text, "\n", "\r\n"); }},
      {"both",
       [](const std::string& text) { return "\xEF\xBB\xBF" + replaced(text, "\n", "\r\n"); }},
      {"no final newline", [](const std::string& text) { return text.substr(0, text.size() - 1); }},
      {"blanks at the ends of lines",
       [](const std::string& text) { return replaced(text, "\n", " \t\n"); }},
      {"tabs for blanks", [](const std::string& text) { return replaced(text, " ", "\t"); }},
      {"blank lines at the end", [](const std::string& text) { return text + "\n \t\n\r\n"; }}};
  for (const Format& format : formats()) {
    const auto expected = format.read(format.text);
    ASSERT_FALSE(expected.empty()) << format.name;
    for (const Variant& variant : variants) {
      SCOPED_TRACE(format.name + " with " + variant.name);
      try {
        EXPECT_EQ(format.read(variant.make(format.text)), expected);
      } catch (const Error& error) {
        ADD_FAILURE() << error.what();
      }
    }
  }
}

TEST(TextLayer, NamesWhatIsThereInPlaceOfData) {
  const std::vector<std::pair<std::string, std::function<std::string(const std::string&)>>> defects{
      {"found UTF-16 text, expected UTF-8",
       [](const std::string& text) { return "\xFF\xFE" + inUtf16(text); }},
      {"found UTF-16 text, expected UTF-8", inUtf16},
      {"found UTF-16 text, expected UTF-8",
       [](const std::string& text) { return "\xFE\xFF" + inBigEndianUtf16(text); }},
      {"found UTF-16 text, expected UTF-8", inBigEndianUtf16},
      {"found lone carriage returns as line ends",
       [](const std::string& text) { return replaced(text, "\n", "\r"); }},
      {"found an HTML page, expected data",
       [](const std::string&) {
         return std::string("\n<!DOCTYPE html><html><head><title>Virus scan warning</title>");
       }},
      {"found an HTML page, expected data",
       [](const std::string&) { return std::string("<HTML>\n<body>404</body></HTML>\n"); }},
      {"found a page of XML, expected data",
       [](const std::string&) {
         return std::string("<?xml version=\"1.0\"?>\n<!DOCTYPE html>\n<html>");
       }},
      {"found a Git LFS pointer, expected the file that it stands for",
       [](const std::string&) {
         return std::string(
             "version https://git-lfs.github.com/spec/v1\noid sha256:4d7a\nsize 1\n");
       }},
      {"found a compressed archive", [](const std::string& text) { return "PK\x03\x04" + text; }},
  };
  for (const Format& format : formats()) {
    for (const auto& [message, make] : defects) {
      try {
        format.read(make(format.text));
        ADD_FAILURE() << format.name << " takes what should be: " << message;
      } catch (const InvalidFile& error) {
        EXPECT_EQ(std::string(error.what()).find("file:1: " + message), 0u)
            << format.name << ": " << error.what();
      }
    }
  }
}

}  // namespace
}  // namespace pcrb
