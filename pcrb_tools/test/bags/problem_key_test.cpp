#include "bags/problem_key.hpp"

#include <gtest/gtest.h>

#include "pcrb_core/error.hpp"
#include "support/expect_error.hpp"
#include "support/log_folder.hpp"
#include "support/temporary_folder.hpp"

namespace pcrb_tools {
namespace {

using pcrb_test::expectError;

ProblemKey someKey() {
  ProblemKey key;
  key.problem_file = "apartment_local.txt";
  key.hash = "12ab";
  key.presentation = {pcrb::PresentationKind::kLocalization, true};
  key.subset = 50;
  key.seed = 7;
  key.secret = pcrb::Secret::fromHex("00112233445566778899aabbccddeeff");
  key.rows[1000000000 * pcrb::kSecond] = {"ffee", "13001298760000"};
  key.rows[1000000000 * pcrb::kSecond + 1] = {"ddcc", "13001298760001"};
  return key;
}

class ProblemKeyTest : public ::testing::Test {
 protected:
  ProblemKey read(const std::string& text) const {
    pcrb_test::writeFile(folder_.file("a.key"), text);
    return readProblemKey(folder_.file("a.key"));
  }

  pcrb_test::TemporaryFolder folder_;
};

TEST_F(ProblemKeyTest, SurvivesItsText) {
  const ProblemKey key = someKey();
  const ProblemKey again = read(formatProblemKey(key));
  EXPECT_EQ(formatProblemKey(again), formatProblemKey(key));
  EXPECT_EQ(again.rows.size(), 2U);
  EXPECT_EQ(again.rows.begin()->second.official_id, "13001298760000");
}

TEST_F(ProblemKeyTest, NamesTheLineThatIsWrong) {
  for (const std::string line :
       {"secret 12", "upright maybe", "presentation mapping", "subset 1 -2", "subset 99999999999 1",
        "problem a 1.0", "problem a x b", "hello", "problem_file a", "upright true"}) {
    const std::string text = "upright true\n" + line + "\n";
    expectError<pcrb::InvalidFile>([&] { read(text); }, "a.key:2: found");
  }
  expectError<pcrb::InvalidFile>([&] { read("problem a 1.0 b\nproblem c 1.0 d\n"); }, "a.key:2");
}

TEST_F(ProblemKeyTest, RefusesAPartOfAKey) {
  std::string text = formatProblemKey(someKey());
  text.erase(text.find("secret"), text.find("problem ") - text.find("secret"));
  expectError<pcrb::InvalidFile>([&] { read(text); }, "an incomplete key");
  expectError<pcrb::InvalidFile>([&] { read(""); }, "an incomplete key");
}

}  // namespace
}  // namespace pcrb_tools
