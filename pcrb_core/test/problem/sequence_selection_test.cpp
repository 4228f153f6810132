#include <gtest/gtest.h>

#include <filesystem>

#include "pcrb_core/error.hpp"
#include "pcrb_core/io/atomic_file.hpp"
#include "pcrb_core/problem/dataset.hpp"
#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"

namespace pcrb {
namespace {

using Positions = std::vector<std::size_t>;

const std::vector<SequenceName> kKnown{
    {"eth", "plain"}, {"eth", "stairs"}, {"tum", "long"}, {"mine", "plain"}};

Positions select(const std::vector<std::string>& words) {
  return selectSequences(kKnown, words, "in the test");
}

TEST(SequenceSelection, TakesAllASequenceADataSetOrBoth) {
  EXPECT_EQ(select({"all"}), (Positions{0, 1, 2, 3}));
  EXPECT_EQ(select({"plain"}), (Positions{0, 3}));
  EXPECT_EQ(select({"eth"}), (Positions{0, 1}));
  EXPECT_EQ(select({"mine/plain"}), (Positions{3}));
}

TEST(SequenceSelection, TakesEachOnceHoweverOftenItIsNamed) {
  EXPECT_EQ(select({"tum", "plain", "eth/plain", "long"}), (Positions{0, 2, 3}));
  EXPECT_EQ(select({}), Positions{});
}

TEST(SequenceSelection, RefusesAWordThatNamesNoneAndListsTheKnown) {
  pcrb_test::expectError<InvalidParameter>(
      [] {
        select({"eth", "attic"});
      },
      "found `attic`", "in the test: eth/plain eth/stairs mine/plain tum/long");
  pcrb_test::expectError<InvalidParameter>([] { select({"tum/plain"}); }, "found `tum/plain`");
  pcrb_test::expectError<InvalidParameter>([] { selectSequences({}, {"all"}, "there"); },
                                           "there: there is none");
}

TEST(SequenceSelection, OfProblemFilesKnowsOnlyThoseOfTheKind) {
  const pcrb_test::TemporaryFolder root;
  std::filesystem::create_directories(root.file("eth"));
  for (const char* file : {"eth/a_local.txt", "eth/a_global.txt", "eth/b_local.txt"}) {
    writeFileAtomically(root.file(file), "");
  }
  const auto local = selectProblemFiles(root.path(), {"eth"}, {Kind::kLocal});
  ASSERT_EQ(local.size(), 2u);
  EXPECT_EQ(local[1].sequence, "b");
  EXPECT_EQ(selectProblemFiles(root.path(), {"all"}, {Kind::kLocal, Kind::kGlobal}).size(), 3u);
  pcrb_test::expectError<InvalidParameter>(
      [&] { selectProblemFiles(root.path(), {"b"}, {Kind::kGlobal}); }, "found `b`",
      "of the asked kind");
}

}  // namespace
}  // namespace pcrb
