#include "supervisor/supervised_command.hpp"

#include <gtest/gtest.h>
#include <signal.h>
#include <stdlib.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <thread>

#include "pcrb_core/error.hpp"

namespace pcrb {
namespace {

using std::chrono::milliseconds;

constexpr const char* kSpin = "while :; do sleep 0.01; done";
constexpr SupervisedCommand::Patience kHurry{milliseconds(20), milliseconds(20)};

class SupervisedCommandTest : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = testing::TempDir() + "pcrb_XXXXXX";
    folder_ = mkdtemp(name.data());
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  /// A shell that sets traps, then writes its process id into a file, then does the rest.
  std::vector<std::string> shell(const std::string& traps, const std::string& rest) const {
    const std::string part = file("part");
    return {"sh", "-c",
            traps + "echo $$ > " + part + "; mv " + part + " " + file("pid") + "; " + rest};
  }

  /// Waits for a condition; one that does not come true within a minute is a failure.
  template <typename Condition>
  static void waitUntil(const Condition& condition) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
    while (!condition()) {
      ASSERT_LT(std::chrono::steady_clock::now(), end) << "waited for a minute in vain";
      std::this_thread::sleep_for(milliseconds(2));
    }
  }

  static void waitUntilEnded(SupervisedCommand& command) {
    waitUntil([&command] { return !command.isRunning(); });
  }

  /// The process that wrote a file, once it has.
  static pid_t writer(const std::string& path) {
    waitUntil([&path] { return std::filesystem::exists(path); });
    pid_t pid = 0;
    std::ifstream(path) >> pid;
    return pid;
  }

  static bool isAlive(pid_t pid) { return kill(pid, 0) == 0; }

  std::string file(const std::string& name) const { return folder_ + "/" + name; }

  std::string folder_;
};

TEST_F(SupervisedCommandTest, EndsACommandThatObeysSigint) {
  SupervisedCommand command(shell("trap 'echo > " + file("int") + "; exit' INT; ", kSpin));
  command.start();
  const pid_t pid = writer(file("pid"));
  EXPECT_TRUE(command.isRunning());
  command.stop();
  EXPECT_FALSE(command.isRunning());
  EXPECT_FALSE(isAlive(pid));
  EXPECT_TRUE(std::filesystem::exists(file("int")));
}

TEST_F(SupervisedCommandTest, TerminatesOneThatIgnoresSigint) {
  SupervisedCommand command(
      shell("trap '' INT; trap 'echo > " + file("term") + "; exit' TERM; ", kSpin),
      {milliseconds(20), milliseconds(60000)});
  command.start();
  const pid_t pid = writer(file("pid"));
  command.stop();
  EXPECT_FALSE(isAlive(pid));
  EXPECT_TRUE(std::filesystem::exists(file("term")));
}

TEST_F(SupervisedCommandTest, KillsOneThatIgnoresEverything) {
  SupervisedCommand command(shell("trap '' INT TERM; ", kSpin), kHurry);
  command.start();
  const pid_t pid = writer(file("pid"));
  command.stop();
  EXPECT_FALSE(isAlive(pid));
}

TEST_F(SupervisedCommandTest, KillsOneThatIsStopped) {
  SupervisedCommand command(shell("", "kill -STOP $$"), kHurry);
  command.start();
  const pid_t pid = writer(file("pid"));
  command.stop();
  EXPECT_FALSE(isAlive(pid));
}

TEST_F(SupervisedCommandTest, EndsWhatACommandLeftBehindInAnotherSession) {
  auto orphan = shell("", "exec sleep 1000");
  SupervisedCommand command({"sh", "-c", "setsid sh -c '" + orphan.back() + "' &"},
                            {milliseconds(20), milliseconds(60000)});
  command.start();
  const pid_t pid = writer(file("pid"));
  waitUntilEnded(command);
  EXPECT_TRUE(isAlive(pid));
  command.stop();
  EXPECT_FALSE(isAlive(pid));
}

TEST_F(SupervisedCommandTest, CanBeStartedAgain) {
  SupervisedCommand command({"sleep", "1000"});
  command.start();
  EXPECT_THROW(command.start(), Error);
  command.stop();
  command.start();
  EXPECT_TRUE(command.isRunning());
}

TEST_F(SupervisedCommandTest, ACommandThatIsNotThereEndsAtOnce) {
  SupervisedCommand command({file("nothing")});
  command.start();
  waitUntilEnded(command);
  command.stop();
}

TEST_F(SupervisedCommandTest, DoesNotHandItsNamespaceOn) {
  setenv("ROS_NAMESPACE", "/pcrb", 1);
  SupervisedCommand command({"sh", "-c", "env > " + file("env")});
  command.start();
  waitUntilEnded(command);
  unsetenv("ROS_NAMESPACE");
  std::ifstream stream(file("env"));
  const std::string text((std::istreambuf_iterator<char>(stream)), {});
  EXPECT_NE(text.find("PATH="), std::string::npos);
  EXPECT_EQ(text.find("ROS_NAMESPACE="), std::string::npos);
}

}  // namespace
}  // namespace pcrb
