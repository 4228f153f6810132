#include "pcrb_server/processes.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "pcrb_core/error.hpp"

namespace pcrb {
namespace {

class StartProgram : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = testing::TempDir() + "pcrb_XXXXXX";
    folder_ = mkdtemp(name.data());
    start_.log = folder_ + "/log";
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  /// Exit status of the program, once it has ended.
  int run() const {
    int status = 0;
    waitpid(startProgram(start_), &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  std::string log() const {
    std::ifstream file(start_.log);
    return {std::istreambuf_iterator<char>(file), {}};
  }

  std::string folder_;
  ProgramStart start_;
};

TEST_F(StartProgram, AppendsBothStreamsToTheLogAndGivesNoInput) {
  std::ofstream(start_.log) << "before\n";
  start_.command = {"sh", "-c", "cat; echo out; echo err >&2; exit 3"};
  EXPECT_EQ(run(), 3);
  EXPECT_EQ(log(), "before\nout\nerr\n");
}

TEST_F(StartProgram, ChangesTheEnvironmentAsAsked) {
  setenv("PCRB_TEST_KEPT", "kept", 1);
  setenv("PCRB_TEST_CHANGED", "old", 1);
  setenv("PCRB_TEST_GONE", "here", 1);
  start_.command = {
      "sh", "-c", "echo $PCRB_TEST_KEPT $PCRB_TEST_CHANGED ${PCRB_TEST_GONE-gone} $PCRB_TEST_NEW"};
  start_.environment = {
      {"PCRB_TEST_CHANGED", "new"}, {"PCRB_TEST_GONE", std::nullopt}, {"PCRB_TEST_NEW", "added"}};
  EXPECT_EQ(run(), 0);
  EXPECT_EQ(log(), "kept new gone added\n");
}

TEST_F(StartProgram, KeepsOneDescriptorOpen) {
  int ends[2];
  ASSERT_EQ(pipe2(ends, O_CLOEXEC), 0);
  start_.command = {"sh", "-c", "echo through >/dev/fd/" + std::to_string(ends[1])};
  EXPECT_NE(run(), 0);
  start_.inherited_descriptor = ends[1];
  EXPECT_EQ(run(), 0);
  char text[16] = {};
  EXPECT_EQ(read(ends[0], text, sizeof text), 8);
  EXPECT_STREQ(text, "through\n");
  close(ends[0]);
  close(ends[1]);
}

TEST_F(StartProgram, HasAProcessGroupOfItsOwn) {
  start_.command = {"sh", "-c", "test $(cut -d' ' -f5 /proc/$$/stat) = $$"};
  EXPECT_EQ(run(), 0);
}

TEST_F(StartProgram, SaysThatAProgramCannotBeRun) {
  start_.command = {"no_such_program"};
  EXPECT_EQ(run(), 127);
  EXPECT_EQ(log(), "cannot start no_such_program: No such file or directory\n");
}

TEST_F(StartProgram, RefusesALogThatCannotBeWritten) {
  start_.command = {"true"};
  start_.log = folder_ + "/no_such_folder/log";
  EXPECT_THROW(startProgram(start_), InvalidFile);
}

TEST(ProcessUsage, SeesThisProcessWork) {
  const auto before = usageOf(getpid());
  ASSERT_TRUE(before);
  EXPECT_GT(before->peak_memory, 1u << 20);
  volatile double sum = 0.0;
  while (usageOf(getpid())->cpu_time <= before->cpu_time) {
    for (int i = 0; i < 100000; ++i) sum = sum + i;
  }
}

TEST(ProcessUsage, HasNothingOfAProcessThatIsNot) { EXPECT_FALSE(usageOf(1 << 30)); }

}  // namespace
}  // namespace pcrb
