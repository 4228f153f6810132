#include "pcrb_core/problem/problem_origin.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "pcrb_core/io/file_hash.hpp"
#include "support/temporary_folder.hpp"

namespace pcrb {
namespace {

class ProblemOriginTest : public ::testing::Test {
 protected:
  ProblemOriginTest() { write(problem_file_, "id source target\n"); }

  static void write(const std::string& path, const std::string& text) {
    std::ofstream(path) << text;
  }

  std::string origin() const { return toolThatDrew(problem_file_, fileHash(problem_file_)); }

  void writeSideFile() const {
    write(problem_file_ + ".yaml",
          "# comment\ntool: sample_problems\nparameters:\n  seed: '1'\noutput_blake2b: " +
              fileHash(problem_file_) + "\n");
  }

  pcrb_test::TemporaryFolder folder_;
  const std::string problem_file_ = folder_.file("plain_local.txt");
};

TEST_F(ProblemOriginTest, IsTheToolThatTheSideFileNames) {
  writeSideFile();
  EXPECT_EQ(origin(), "sample_problems");
}

TEST_F(ProblemOriginTest, IsUnknownWithoutASideFile) { EXPECT_EQ(origin(), ""); }

TEST_F(ProblemOriginTest, IsUnknownOfAFileThatReplacedTheOneThatWasDrawn) {
  writeSideFile();
  write(problem_file_, "id source target overlap\n");
  EXPECT_EQ(origin(), "");
}

}  // namespace
}  // namespace pcrb
