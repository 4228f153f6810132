#include "pcrb_core/problem/dataset.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "pcrb_core/error.hpp"
#include "pcrb_core/io/atomic_file.hpp"
#include "support/shared_data.hpp"
#include "support/temporary_folder.hpp"

namespace pcrb {
namespace {

namespace fs = std::filesystem;
using Texts = std::vector<std::string>;

void expectRange(const Range& range, double min, double max) {
  EXPECT_EQ(range.min, min);
  EXPECT_EQ(range.max, max);
}

/// Loads a data set whose dataset.yaml has this content.
Dataset loadYaml(const std::string& yaml, const std::string& name = "mine") {
  const pcrb_test::TemporaryFolder root;
  fs::create_directory(root.file(name));
  writeFileAtomically(root.file(name) + "/dataset.yaml", yaml);
  return loadDataset(root.path(), name);
}

/// What loading says about a dataset.yaml, from its name on; "no error" if it takes it.
std::string messageFor(const std::string& yaml) {
  try {
    loadYaml(yaml);
  } catch (const InvalidFile& error) {
    const std::string message = error.what();
    return message.substr(message.find("dataset.yaml"));
  }
  return "no error";
}

TEST(Dataset, PublishedOnesHaveTheMeasuredParameters) {
  const Dataset eth = loadDataset("/nowhere", "eth");
  EXPECT_EQ(eth.overlap_distance, 0.1);
  EXPECT_EQ(eth.voxel_leaf, 0.2);
  expectRange(eth.bounds(Kind::kLocal).translation, 0, 1);
  expectRange(eth.bounds(Kind::kLocal).rotation_deg, 0, 30);
  expectRange(eth.bounds(Kind::kGlobal).translation, 1.5, 10);
  expectRange(eth.bounds(Kind::kGlobal).rotation_deg, 45, 180);
  const Dataset planetary = loadDataset("/nowhere", "planetary");
  EXPECT_EQ(planetary.overlap_distance, 0.2);
  expectRange(planetary.local.translation, 0, 3);
  expectRange(planetary.global.translation, 5, 20);
  const Dataset tum = loadDataset("/nowhere", "tum");
  EXPECT_EQ(tum.overlap_distance, 0.01);
  EXPECT_EQ(tum.voxel_leaf, 0.1);
  expectRange(tum.local.translation, 0, 1);
  expectRange(tum.global.translation, 1.5, 15);
  const Dataset kaist = loadDataset("/nowhere", "kaist");
  EXPECT_EQ(kaist.overlap_distance, 0.2);
  expectRange(kaist.local.translation, 0, 1);
  expectRange(kaist.global.translation, 1.5, 15);
}

TEST(Dataset, BoundsOfTheNoteDifferWhereTheNoteDoes) {
  expectRange(loadDataset("/nowhere", "eth", BoundsSource::kNote).global.translation, 1.5, 15);
  expectRange(loadDataset("/nowhere", "planetary", BoundsSource::kNote).local.translation, 0, 2);
  const Dataset kaist = loadDataset("/nowhere", "kaist", BoundsSource::kNote);
  expectRange(kaist.local.translation, 0, 2);
  expectRange(kaist.global.translation, 4, 15);
}

TEST(Dataset, UnknownOnesHaveTheDefaults) {
  const Dataset mine = loadDataset("/nowhere", "mine");
  EXPECT_EQ(mine.name, "mine");
  EXPECT_EQ(mine.overlap_distance, 0.2);
  EXPECT_EQ(mine.voxel_leaf, 0.2);
  expectRange(mine.local.translation, 0, 3);
  expectRange(mine.global.translation, 5, 20);
}

TEST(Dataset, YamlOverridesKeyByKey) {
  const Dataset tum = loadYaml("local: {translation: [0.5, 2]}\nsensor: stereo\n", "tum");
  expectRange(tum.local.translation, 0.5, 2);
  expectRange(tum.local.rotation_deg, 0, 30);
  EXPECT_EQ(tum.overlap_distance, 0.01);
  EXPECT_EQ(tum.sensor, "stereo");
  EXPECT_EQ(tum.characteristics, (Texts{"indoor", "structured", "rgbd"}));
}

TEST(Dataset, ReadsTheSharedOnes) {
  PCRB_REQUIRE_SHARED_DATA();
  const std::string root = pcrb_test::sharedData() + "/benchmark";
  const Dataset automotive = loadDataset(root, "automotive");
  EXPECT_EQ(automotive.overlap_distance, 0.3);
  expectRange(automotive.global.translation, 4, 15);
  EXPECT_EQ(automotive.characteristics, (Texts{"outdoor", "urban", "structured", "lidar"}));
  EXPECT_EQ(loadDataset(root, "handheld").sensor, "3D lidar");
  EXPECT_EQ(loadDataset(root, "rgbd").voxel_leaf, 0.1);
}

TEST(Dataset, RejectsUnknownKeysWithTheirLine) {
  const std::string names = "characteristics, global, local, overlap_distance, sensor, voxel_leaf";
  EXPECT_EQ(messageFor("sensor: a\noverlap: 0.2\n"),
            "dataset.yaml:2: found unknown key 'overlap', expected one of " + names);
  EXPECT_EQ(
      messageFor("local: {rotation: [0, 1]}\n"),
      "dataset.yaml:1: found unknown key 'rotation', expected one of rotation_deg, translation");
}

TEST(Dataset, RejectsAKeyTwice) {
  EXPECT_EQ(messageFor("voxel_leaf: 1\nsensor: a\nvoxel_leaf: 2\n"),
            "dataset.yaml:3: found key 'voxel_leaf' again, expected it once");
}

TEST(Dataset, RejectsLengthsThatAreNone) {
  EXPECT_EQ(messageFor("\nvoxel_leaf: 0\n"),
            "dataset.yaml:2: found '0', expected a length above 0 m");
  for (const std::string value : {"abc", "0.2 m", ".inf", "nan"}) {
    EXPECT_EQ(messageFor("overlap_distance: " + value),
              "dataset.yaml:1: found '" + value + "', expected a finite number");
  }
  EXPECT_EQ(messageFor("voxel_leaf: [1]"),
            "dataset.yaml:1: found a list, expected a finite number");
  EXPECT_EQ(messageFor("voxel_leaf:\nsensor: a\n"),
            "dataset.yaml:1: found nothing after 'voxel_leaf', expected a value");
}

TEST(Dataset, RejectsImpossibleRanges) {
  const std::string expected = "expected [min, max] with 0 <= min <= max";
  for (const std::string value : {"[2, 1]", "[-1, 1]"}) {
    EXPECT_EQ(messageFor("local:\n  translation: " + value),
              "dataset.yaml:2: found " + value + ", " + expected);
  }
  EXPECT_EQ(messageFor("global: {translation: [1]}"), "dataset.yaml:1: found a list, " + expected);
  EXPECT_EQ(messageFor("global: {translation: 5}"), "dataset.yaml:1: found '5', " + expected);
  EXPECT_EQ(messageFor("global: {rotation_deg: [0, 181]}"),
            "dataset.yaml:1: found [0, 181], " + expected + " <= 180");
}

TEST(Dataset, RejectsTextsThatAreNone) {
  EXPECT_EQ(messageFor("sensor: [a]"), "dataset.yaml:1: found a list, expected a text");
  EXPECT_EQ(messageFor("characteristics: a"),
            "dataset.yaml:1: found 'a', expected a list of texts");
  EXPECT_EQ(messageFor("characteristics: [{a: b}]"),
            "dataset.yaml:1: found a map, expected a text");
}

TEST(Dataset, RejectsWhatIsNoYamlMap) {
  EXPECT_EQ(messageFor("- a\n").substr(0, 44), "dataset.yaml:1: found a list, expected a map");
  EXPECT_NE(messageFor("").find("found nothing, expected a map"), std::string::npos);
  EXPECT_EQ(messageFor("sensor: a\nlocal: {translation: [0, 1}\n").substr(0, 15),
            "dataset.yaml:2:");
}

/// The parts of sequences that the layout decides, one line each.
Texts describe(const std::vector<SequenceFiles>& sequences, const std::string& root) {
  Texts lines;
  for (const SequenceFiles& files : sequences) {
    lines.push_back(files.data_set + " " + files.sequence + " " + toString(files.kind) + " " +
                    files.problem_file.substr(root.size()) + " " +
                    files.cloud_folder.substr(root.size()));
  }
  return lines;
}

TEST(FindSequences, FindsTheCommonLayoutSorted) {
  const pcrb_test::TemporaryFolder root;
  fs::create_directories(root.file("planetary/p2at_met"));
  fs::create_directories(root.file("eth/.hidden"));
  for (const char* file : {"planetary/planetary_map_local.txt", "planetary/p2at_met_local.txt",
                           "planetary/p2at_met_global.txt", "eth/plain_global.txt", "readme.txt",
                           "eth/plain_overlap.txt", "eth/_local.txt", "eth/.plain_local.txt",
                           "eth/plain_local.txt.bak"}) {
    writeFileAtomically(root.file(file), "");
  }
  const Texts expected = {
      "eth plain global /eth/plain_global.txt /eth/plain",
      "planetary p2at_met local /planetary/p2at_met_local.txt /planetary/p2at_met",
      "planetary p2at_met global /planetary/p2at_met_global.txt /planetary/p2at_met",
      "planetary planetary_map local /planetary/planetary_map_local.txt /planetary/p2at_met"};
  EXPECT_EQ(describe(findSequences(root.path()), root.path()), expected);
}

TEST(FindSequences, FindsTheSharedSequences) {
  PCRB_REQUIRE_SHARED_DATA();
  const auto sequences = findSequences(pcrb_test::sharedData() + "/benchmark");
  ASSERT_EQ(sequences.size(), 6u);
  EXPECT_EQ(sequences[0].sequence, "street");
  EXPECT_EQ(sequences[0].kind, Kind::kLocal);
  EXPECT_EQ(sequences[5].data_set, "rgbd");
  for (const SequenceFiles& files : sequences) {
    EXPECT_TRUE(fs::is_directory(files.cloud_folder)) << files.cloud_folder;
  }
}

TEST(FindSequences, RejectsARootThatIsNoFolder) {
  EXPECT_THROW(findSequences("/nowhere"), InvalidFile);
}

}  // namespace
}  // namespace pcrb
