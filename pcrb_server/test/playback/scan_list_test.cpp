#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "pcrb_core/error.hpp"
#include "pcrb_server/playback/scene.hpp"

namespace pcrb {
namespace {

class ScanListTest : public ::testing::Test {
 protected:
  ScanListTest() {
    std::string pattern =
        (std::filesystem::temp_directory_path() / "pcrb_scan_list_XXXXXX").string();
    path_ = std::string(mkdtemp(pattern.data())) + "/scans.txt";
  }
  ~ScanListTest() override {
    std::filesystem::remove_all(std::filesystem::path(path_).parent_path());
  }

  ScanList read(const std::string& text) const {
    std::ofstream(path_) << text;
    return readScanList(path_);
  }

  std::string path_;
};

TEST_F(ScanListTest, SurvivesItsText) {
  Scene scene;
  scene.local_origin = {332400.0, -4151400.0, 0.0};
  std::string text;
  for (const char* name : {"PointCloud2.pcd", "PointCloud10.pcd"}) {
    scene.name = name;
    scene.stamp += ros::Duration(1000000000, 7);
    appendScan(text, scene);
  }
  const ScanList list = read(text);
  EXPECT_EQ(list.local_origin, scene.local_origin);
  const std::map<Stamp, std::string> expected{{1000000000000000007, "PointCloud2.pcd"},
                                              {2000000000000000014, "PointCloud10.pcd"}};
  EXPECT_EQ(list.scans, expected);
}

TEST_F(ScanListTest, NamesTheLineThatIsWrong) {
  for (const char* text :
       {"1.5 a.pcd\n2.5\n", "1.5 a.pcd\n2.5 b.pcd c\n", "1.5 a.pcd\nx b.pcd\n",
        "1.5 a.pcd\n1.5 b.pcd\n", "1.5 a.pcd\n2.5 ../b.pcd\n", "1.5 a.pcd\n# local_origin 1 2\n",
        "1.5 a.pcd\n# local_origin 1 2 nan\n"}) {
    try {
      read(text);
      ADD_FAILURE() << "took " << text;
    } catch (const InvalidFile& error) {
      EXPECT_NE(std::string(error.what()).find("scans.txt:2: found"), std::string::npos)
          << error.what();
    }
  }
  EXPECT_THROW(read("# nothing\n"), InvalidFile);
}

}  // namespace
}  // namespace pcrb
