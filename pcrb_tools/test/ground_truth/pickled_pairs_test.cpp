#include "ground_truth/pickled_pairs.hpp"

#include <gtest/gtest.h>

#include <sstream>

#include "ground_truth/ground_truth_tool.hpp"
#include "ground_truth/pair_evaluation.hpp"
#include "pcrb_core/error.hpp"
#include "pcrb_core/io/atomic_file.hpp"
#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"

namespace pcrb_tools {
namespace {

using namespace std::string_literals;

// What Python's pickle makes of ['tool', '-r 0.1', 'apartment/a.pcd'], then of two rows, with
// protocols 2 and 5.
constexpr const char* kProtocol2 =
    "80025d7100285804000000746f6f6c710158060000002d7220302e317102580f00000061706172746d65"
    "6e742f612e7063647103652e80025d7100285d710128473fa999999999999a473f9eb851eb851eb84700"
    "0000000000000047bfa47ae147ae147b4700000000000000004700000000000000004700000000000000"
    "00473ff0000000000000655d710228473fd0000000000000470000000000000000473fc999999999999a"
    "470000000000000000470000000000000000473fb999999999999a470000000000000000473fefd6efe4"
    "c9b8a565652e";
constexpr const char* kProtocol5 =
    "80059527000000000000005d94288c04746f6f6c948c062d7220302e31948c0f61706172746d656e742f"
    "612e70636494652e8005959d000000000000005d94285d9428473fa999999999999a473f9eb851eb851e"
    "b847000000000000000047bfa47ae147ae147b4700000000000000004700000000000000004700000000"
    "00000000473ff0000000000000655d9428473fd0000000000000470000000000000000473fc999999999"
    "999a470000000000000000470000000000000000473fb999999999999a470000000000000000473fefd6"
    "efe4c9b8a565652e";

std::string bytesOf(const std::string& hexadecimal) {
  std::string bytes;
  for (std::size_t i = 0; i < hexadecimal.size(); i += 2) {
    bytes += static_cast<char>(std::stoi(hexadecimal.substr(i, 2), nullptr, 16));
  }
  return bytes;
}

class PickledPairs : public ::testing::Test {
 protected:
  std::string write(const std::string& bytes) {
    const std::string path = folder_.file("apartment_gt_check.dat");
    pcrb::writeFileAtomically(path, bytes);
    return path;
  }
  void expectRefusal(const std::string& bytes, const std::string& found) {
    const std::string path = write(bytes);
    pcrb_test::expectError<pcrb::InvalidFile>([&] { readPickledPairs(path); },
                                              "apartment_gt_check.dat", found);
  }

  pcrb_test::TemporaryFolder folder_;
};

TEST_F(PickledPairs, AreTheRowsOfThePublishedFiles) {
  for (const char* file : {kProtocol2, kProtocol5}) {
    EXPECT_EQ(readPickledPairs(write(bytesOf(file))),
              "misalignment_m,tx,ty,tz,qx,qy,qz,qw\n"
              "0.05,0.03,0,-0.04,0,0,0,1\n"
              "0.25,0,0.2,0,0,0.1,0,0.99498743710662\n");
  }
}

TEST_F(PickledPairs, AreImportedWithTheirTranslationsAndRotations) {
  GroundTruthOptions options;
  options.output = folder_.file("out");
  options.imports = {"eth=" + write(bytesOf(kProtocol2))};
  std::ostringstream out;
  runGroundTruthTool(options, out);
  EXPECT_NE(out.str().find("eth: 0.15 ± 0.10 m (apartment)"), std::string::npos) << out.str();
  const PairFile pairs = parsePairFile(readPickledPairs(write(bytesOf(kProtocol2))), "a");
  ASSERT_EQ(pairs.translations.size(), 2u);
  EXPECT_NEAR(pairs.translations[0], 0.05, 1e-12);
  EXPECT_NEAR(pairs.translations[1], 0.2, 1e-12);
  EXPECT_NEAR(pairs.rotations_deg[0], 0.0, 1e-12);
  EXPECT_NEAR(pairs.rotations_deg[1], 11.478340954533572, 1e-9);  // 2 asin 0.1
}

TEST_F(PickledPairs, AreReadFromOlderProtocolsAndTuplesToo) {
  // pickle.dumps(('tool', '-r'), 0), then of [(0.05, 3, -70000, 2**40, 0.0, 0.0, 0.0, 1.0)].
  const std::string text =
      "(Vtool\np0\nV-r\np1\ntp2\n."
      "(lp0\n(F0.05\nI3\nI-70000\nL1099511627776L\nF0.0\nF0.0\nF0.0\nF1.0\ntp1\na.";
  // The same with protocols 1 (a tuple of a mark, text of Python 2) and 2 (LONG1, TUPLE2).
  const std::string numbers = std::string("G?\xa9\x99\x99\x99\x99\x99\x9aK\x03J") +
                              "\x90\xee\xfe\xff" + "L1099511627776L\n";
  const std::string zeros = "K\0K\0K\0K\x01"s;
  const std::string protocol1 = "(U\x04toolU\x02-rt.](" + numbers + zeros + "ta.";
  std::string protocol2 = "\x80\x02U\x04toolU\x02-r\x86.](" + numbers + zeros + "ta.";
  protocol2.replace(protocol2.find("L1099511627776L\n"), 16, "\x8a\x06\0\0\0\0\0\x01"s);
  for (const std::string& pickle : {text, protocol1, protocol2}) {
    EXPECT_EQ(readPickledPairs(write(pickle)),
              "misalignment_m,tx,ty,tz,qx,qy,qz,qw\n0.05,3,-70000,1099511627776,0,0,0,1\n");
  }
}

TEST_F(PickledPairs, RefusesAPickleThatMakesAnythingElse) {
  expectRefusal("cos\nsystem\n(S'true'\ntR.", "Python's 'os.system', which is not run");
  expectRefusal("(S'true'\nios\nsystem\n.", "'os.system'");
  expectRefusal("\x80\x04\x8c\x02os\x8c\x06system\x93.", "'os.system'");
  expectRefusal("K\x01K\x02R.", "the opcode 82");      // REDUCE
  expectRefusal("K\x01K\x02\x81.", "the opcode 129");  // NEWOBJ
  expectRefusal("\x80\x02}q\x00.", "the opcode 125");  // a dictionary
}

TEST_F(PickledPairs, RefusesWhatIsCutOffOrOfAnotherShape) {
  const std::string whole = bytesOf(kProtocol2);
  for (std::size_t size = 0; size < whole.size(); ++size) {
    const std::string path = write(whole.substr(0, size));
    EXPECT_THROW(readPickledPairs(path), pcrb::InvalidFile) << size;
  }
  expectRefusal(whole + "x", "more behind the rows");
  expectRefusal("].K\x01.", "no list");
  expectRefusal(
      "].]K\x01"
      "a.",
      "a row that is no list");
  expectRefusal(
      "].](]K\x01"
      "ae.",
      "a row of 1 numbers");
  expectRefusal("].]e.", "no mark");
  expectRefusal(
      "].K\x01K\x02"
      "a.",
      "something added to no list");
  expectRefusal(".", "nothing on the stack");
  expectRefusal("(.", "a mark");
  expectRefusal("h\x05.", "not remembered");
}

TEST_F(PickledPairs, SaysOfRowsWithSixNumbersThatTheyCannotBeUsed) {
  std::string six = "](";
  for (int i = 0; i < 6; ++i) six += "K\x01";
  expectRefusal("].]" + six + "ea.", "rows of 6 numbers");
}

TEST_F(PickledPairs, NameTheirSequence) {
  EXPECT_TRUE(isPickled("a/long_office_household_gt_check.dat"));
  EXPECT_FALSE(isPickled("a/plain.csv"));
  EXPECT_EQ(sequenceOfPickled("a/long_office_household_gt_check.dat"), "long_office_household");
  EXPECT_EQ(sequenceOfPickled("a/urban05_gt_check_02.dat"), "urban05");
}

}  // namespace
}  // namespace pcrb_tools
