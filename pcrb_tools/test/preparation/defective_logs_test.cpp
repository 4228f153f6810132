#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "pcrb_core/error.hpp"
#include "preparation/preparation.hpp"
#include "support/expect_error.hpp"
#include "support/log_folder.hpp"
#include "support/sample_log_support.hpp"
#include "support/temporary_folder.hpp"

namespace pcrb_tools {
namespace {

namespace fs = std::filesystem;
using Damage = std::function<std::string(std::string)>;

/// Something that is wrong with one file of a log.
struct Defect {
  std::string name;  ///< of the test
  std::string data_set;
  std::string sequence;
  std::string file;   ///< below the logs; the second one of a folder if it ends with `/`
  Damage damage;      ///< of its bytes
  std::string place;  ///< what follows the file's name in the error
};

Damage replacing(const std::string& bytes) {
  return [bytes](const std::string&) { return bytes; };
}

Damage appending(const std::string& text) {
  return [text](std::string bytes) { return bytes + text; };
}

Damage cuttingLast(std::size_t count) {
  return [count](std::string bytes) { return bytes.substr(0, bytes.size() - count); };
}

/// @param number  counted from 1
Damage replacingLine(int number, const std::string& line) {
  return [number, line](std::string bytes) {
    std::size_t begin = 0;
    for (int i = 1; i < number; ++i) begin = bytes.find('\n', begin) + 1;
    return bytes.replace(begin, bytes.find('\n', begin) - begin, line);
  };
}

const char* const kPage = "<!DOCTYPE html>\n<html>Download anyway?</html>\n";

/// Makes defects of a sequence, whose files' names start alike.
auto defectsOf(const std::string& data_set, const std::string& sequence, const std::string& start) {
  return [=](const char* name, const std::string& file, const Damage& damage, const char* place) {
    return Defect{name, data_set, sequence, start + file, damage, place};
  };
}

std::vector<Defect> ethDefects() {
  const auto defect = defectsOf("eth", "apartment", "eth/apartment/");
  return {
      defect("EthRowCutShort", "csv_global/PointCloud1.csv", replacingLine(5, "1322935991.0, 3.9"),
             ":5: found 2 columns"),
      defect("EthWordForANumber", "csv_global/PointCloud1.csv",
             replacingLine(3, "1322935991.0, 1, 2, x, -1, 0, 1"), ":3: "),
      defect("EthDecimalComma", "csv_global/PointCloud1.csv",
             replacingLine(3, "1322935991,0, 1, 2, 3, -1, 0, 1"), ":3: found 8 columns"),
      defect("EthHeaderWithoutZ", "csv_global/PointCloud1.csv",
             replacingLine(1, "Time_in_sec, x, y, Intensities, 2DscanId, PointId"), ":1: "),
      defect("EthPageForAScan", "csv_global/PointCloud1.csv", replacing(kPage), ":1: "),
      defect("EthEmptyScan", "csv_global/PointCloud1.csv", replacing(""), ": "),
      defect("EthPoseCutShort", "leica/pose_scanner_leica.csv", replacingLine(3, "1, 9, 1, 0"),
             ":3: found 4 numbers"),
      defect("EthPoseThatIsNoRotation", "leica/pose_scanner_leica.csv",
             replacingLine(2, "0, 9, 2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 1"), ":2: "),
  };
}

std::vector<Defect> planetaryDefects() {
  const auto defect =
      defectsOf("planetary", "box_met", "planetary/box_met/box_met_001/box_met_001.");
  return {
      defect("PlanetaryPoseRowCutShort", "gt", replacingLine(2, "0 1 0"), ":2: found 3 numbers"),
      defect("PlanetaryPoseWithNan", "gt", replacingLine(1, "1 0 nan 0"), ":1: "),
      defect("PlanetaryPoseThatMirrors", "gt", replacing("1 0 0 0\n0 1 0 0\n0 0 -1 0\n0 0 0 1\n"),
             ":4: found a matrix"),
      defect("PlanetaryPoseOfThreeRows", "gt", replacing("1 0 0 0\n0 1 0 0\n0 0 1 0\n\n\n"),
             ": found 3 rows"),
      defect("PlanetaryScanWithoutAPoint", "xyz", replacing("\n\n"), ": "),
      defect("PlanetaryPageForAScan", "xyz", replacing(kPage), ":1: found an HTML page"),
  };
}

std::vector<Defect> tumDefects() {
  const auto defect = defectsOf("tum", "pioneer_slam", "tum/rgbd_dataset_freiburg2_pioneer_slam");
  return {
      defect("TumPoseCutShort", "-groundtruth.txt",
             replacingLine(5, "1311877977.6 0.1 0.2 0.3 0 0 1"),
             ":5: found '1311877977.6 0.1 0.2 0.3 0 0 1' (7 fields)"),
      defect("TumQuaternionOfNormZero", "-groundtruth.txt",
             replacingLine(5, "1311877977.6 0.1 0.2 0.3 0 0 0 0"), ":5: "),
      defect("TumStampThatIsNoNumber", "-groundtruth.txt",
             replacingLine(5, "1311877977.6s 0.1 0.2 0.3 0 0 0 1"), ":5: found '1311877977.6s'"),
      defect("TumPageForPoses", "-groundtruth.txt", replacing(kPage), ":1: "),
      defect("TumNoPose", "-groundtruth.txt", replacing("# nothing\n"), ": found no pose"),
      defect("TumBagCutShort", "-2hz-with-pointclouds.bag", cuttingLast(1000), ": "),
      defect("TumPageForABag", "-2hz-with-pointclouds.bag", replacing(kPage), ": "),
  };
}

std::vector<Defect> kaistDefects() {
  const auto defect = defectsOf("kaist", "urban05", "kaist/urban05/");
  return {
      defect("KaistScanCutShort", "sensor_data/VLP_left/", cuttingLast(3), ": found "),
      defect("KaistRightScanCutShort", "sensor_data/VLP_right/", cuttingLast(3), ": found "),
      defect("KaistStampThroughADouble", "sensor_data/VLP_left_stamp.csv",
             replacingLine(2, "1.519102894e+18"), ":2: "),
      defect("KaistPoseCutShort", "global_pose.csv", replacingLine(4, "1519102894180000000,1,0"),
             ":4: found 2 numbers"),
      defect("KaistPoseStampThroughADouble", "global_pose.csv",
             replacingLine(1, "1.519102894e+18,1,0,0,353413,0,1,0,4026881,0,0,1,20"), ":1: "),
      defect("KaistPageForPoses", "global_pose.csv", replacing(kPage), ":1: "),
      defect("KaistCalibrationWithRpyOnly", "calibration/Vehicle2LeftVLP.txt",
             replacing("RPY: 1 2 3\nT: 1 2 3\n"), ": found no line 'R:'"),
      defect("KaistCalibrationOfEightNumbers", "calibration/Vehicle2RightVLP.txt",
             replacing("RPY: 1 2 3\nR: 1 0 0 0 1 0 0 0\nT: 1 2 3\n"), ":2: found 8 numbers"),
      defect("KaistCalibrationWithAWord", "calibration/Vehicle2RightVLP.txt",
             appending("T: one two three\n"), ":6: "),
  };
}

std::vector<Defect> allDefects() {
  std::vector<Defect> all;
  for (const auto& some : {ethDefects(), planetaryDefects(), tumDefects(), kaistDefects()}) {
    all.insert(all.end(), some.begin(), some.end());
  }
  return all;
}

void PrintTo(const Defect& defect, std::ostream* out) { *out << defect.name; }

/// Converts the logs of a sequence; the clouds' bytes by name.
std::map<std::string, std::string> convert(const std::string& logs, const std::string& root,
                                           const Defect& defect) {
  PrepareOptions options;
  options.logs = logs;
  options.root = root;
  options.sequences = {defect.data_set + '/' + defect.sequence};
  options.last = PrepareStage::kConvert;
  std::ostringstream out;
  prepareDataset(options, out);
  auto files = pcrb_test::readTree(fs::path(root) / defect.data_set / defect.sequence);
  files.erase(".conversion");
  return files;
}

/// Simulated logs of a data set and its sequences' clouds, made once for all defects.
class GoodLogs {
 public:
  static const GoodLogs& of(const Defect& defect) {
    static std::map<std::string, GoodLogs> logs;
    return logs.try_emplace(defect.data_set, defect).first->second;
  }

  explicit GoodLogs(const Defect& defect) {
    using namespace simulation;
    const std::map<std::string, LogPlan (*)(const LogOptions&)> planners{
        {"eth", planEthLogs},
        {"planetary", planPlanetaryLogs},
        {"tum", planTumLogs},
        {"kaist", planKaistLogs}};
    pcrb_test::makeLogs(planners.at(defect.data_set)(pcrb_test::tinyLogs()), logs());
    clouds = convert(logs(), folder_.file("root"), defect);
  }

  std::string logs() const { return folder_.file("logs"); }

  std::map<std::string, std::string> clouds;

 private:
  pcrb_test::TemporaryFolder folder_;
};

class DefectiveLog : public testing::TestWithParam<Defect> {};

TEST_P(DefectiveLog, IsNamedWithItsPlaceLeavesNothingHalfWrittenAndIsConvertedOnceMended) {
  const Defect& defect = GetParam();
  const GoodLogs& good = GoodLogs::of(defect);
  const pcrb_test::TemporaryFolder folder;
  const std::string logs = folder.file("logs");
  const std::string root = folder.file("root");
  fs::copy(good.logs(), logs, fs::copy_options::recursive);
  std::string file = logs + '/' + defect.file;
  if (file.back() == '/') file += pcrb_test::namesIn(file).at(1);
  const std::string sound = pcrb_test::readFile(file);
  pcrb_test::writeFile(file, defect.damage(sound));

  PCRB_EXPECT_ERROR(pcrb::InvalidFile, convert(logs, root, defect),
                    fs::path(file).filename().string() + defect.place);
  const fs::path clouds = fs::path(root) / defect.data_set / defect.sequence;
  if (fs::exists(clouds)) {
    for (const auto& [name, bytes] : pcrb_test::readTree(clouds)) {
      if (name != ".conversion") {
        EXPECT_EQ(bytes, good.clouds.at(name)) << name;
      }
    }
  }
  pcrb_test::writeFile(file, sound);
  EXPECT_TRUE(convert(logs, root, defect) == good.clouds);
}

INSTANTIATE_TEST_SUITE_P(Formats, DefectiveLog, testing::ValuesIn(allDefects()),
                         [](const auto& instance) { return instance.param.name; });

}  // namespace
}  // namespace pcrb_tools
