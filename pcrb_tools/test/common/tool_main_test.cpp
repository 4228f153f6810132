#include "common/tool_main.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <cstdlib>
#include <string>
#include <vector>

#include "common/process.hpp"
#include "pcrb_core/error.hpp"

namespace pcrb_tools {
namespace {

struct Outcome {
  int status = -1;
  std::string out;
  std::string err;
};

/// Runs a tool with one option `--number` and the arguments.
Outcome run(std::vector<std::string> arguments, const std::function<int(int)>& body) {
  arguments.insert(arguments.begin(), "/opt/bin/some_tool");
  std::vector<char*> argv;
  for (auto& argument : arguments) argv.push_back(argument.data());
  argv.push_back(nullptr);
  CLI::App app("Does something.");
  int number = 0;
  app.add_option("--number", number, "a number");
  Outcome outcome;
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  outcome.status =
      runTool(app, static_cast<int>(arguments.size()), argv.data(), [&] { return body(number); });
  outcome.out = testing::internal::GetCapturedStdout();
  outcome.err = testing::internal::GetCapturedStderr();
  return outcome;
}

long pageFaults() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_minflt;
}

TEST(ToolMain, TakesTheMemoryOfOneCloudForTheNext) {
  const auto convertCloud = [] {
    constexpr std::size_t kSize = 20 << 20;
    const std::vector<char> log(kSize, 'l');
    const std::vector<char> points(kSize, 'p');
    const std::vector<char> text(kSize, 't');
    return log.back() == 'l' && points.back() == 'p' && text.back() == 't';
  };
  const Outcome outcome = run({}, [&](int) {
    if (!convertCloud()) return kFailure;
    const long before = pageFaults();
    for (int i = 0; i < 2; ++i) {
      if (!convertCloud()) return kFailure;
    }
    // These clouds have 15360 pages each; some faults belong to whatever else the program does.
    return pageFaults() - before < 1000 ? kSuccess : kFailure;
  });
  EXPECT_EQ(outcome.status, kSuccess);
}

TEST(ToolMain, IgnoresWhatRoslaunchAppends) {
  const Outcome outcome = run({"--number", "7", "__name:=x", "__log:=/tmp/x.log", "a:=b"},
                              [](int number) { return number == 7 ? kSuccess : kFailure; });
  EXPECT_EQ(outcome.status, 0) << outcome.err;
}

TEST(ToolMain, HelpSucceedsAndGoesToStandardOutput) {
  const Outcome outcome = run({"--help"}, [](int) -> int { return kFailure; });
  EXPECT_EQ(outcome.status, 0);
  EXPECT_NE(outcome.out.find("Does something."), std::string::npos);
  EXPECT_NE(outcome.out.find("--number"), std::string::npos);
}

TEST(ToolMain, AnInterruptBecomesOneLineAndTheStatusThatAShellHasForIt) {
  for (const int signal : {SIGINT, SIGTERM}) {
    const Outcome outcome = run({}, [signal](int) -> int {
      const Interruption interruption;
      std::raise(signal);
      Interruption::check();
      return kSuccess;
    });
    EXPECT_EQ(outcome.status, 128 + SIGINT);
    EXPECT_EQ(outcome.err,
              "some_tool: interrupted; what is complete is kept and the next run goes on from "
              "there\n");
  }
}

TEST(ToolMain, ErrorOfTheCoreBecomesOneLineAndStatusOne) {
  const Outcome outcome =
      run({}, [](int) -> int { throw pcrb::InvalidFile("a.pcd", 3, "two\nlines", "one"); });
  EXPECT_EQ(outcome.status, kFailure);
  EXPECT_EQ(outcome.err, "some_tool: a.pcd:3: found two lines, expected one\n");
  EXPECT_EQ(outcome.out, "");
}

TEST(ToolMain, UnknownOptionIsOneLineAndStatusTwo) {
  const Outcome outcome = run({"--nmber", "3"}, [](int) -> int { return kSuccess; });
  EXPECT_EQ(outcome.status, kUsageError);
  EXPECT_NE(outcome.err.find("--nmber"), std::string::npos);
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
}

TEST(ToolMain, ChoiceTakesItsWordsAndNamesThemToWhoeverGivesAnother) {
  CLI::App app("Chooses.");
  int value = 0;
  addChoice<int>(app, "--size", value, {{"small", 1}, {"large", 2}}, "of it");
  app.parse("--size large");
  EXPECT_EQ(value, 2);
  try {
    app.parse("--size 1");
    FAIL() << "took a value for a word";
  } catch (const CLI::ValidationError& error) {
    EXPECT_STREQ(error.what(), "--size: 1 not in {large,small}");
  }
}

TEST(ToolMain, TakesATildeThatTheShellLeftAloneForTheHomeFolder) {
  const std::string home = std::getenv("HOME") == nullptr ? "/nowhere" : std::getenv("HOME");
  setenv("HOME", home.c_str(), 1);
  for (const auto& [word, expected] : std::vector<std::pair<std::string, std::string>>{
           {"--run=~/runs/a", "--run=" + home + "/runs/a"},
           {"root:=~/pcrb", "root:=" + home + "/pcrb"},
           {"mine=~/runs/a", "mine=" + home + "/runs/a"},
           {"~/runs/a", home + "/runs/a"}}) {
    EXPECT_EQ(withHomeFolder(word), expected);
  }
  for (const std::string word : {"~", "~me/a", "--run=~me/a", "/a=~/b", "./~/a", "a~/b", ""}) {
    EXPECT_EQ(withHomeFolder(word), word);
  }
}

TEST(TemporaryFolder, NamesTheVariableThatLeadsNowhere) {
  const char* const before = std::getenv("TMPDIR");
  const std::string value = before == nullptr ? "" : before;
  setenv("TMPDIR", "/nowhere/tmp", 1);
  try {
    const TemporaryFolder folder("pcrb_test");
    ADD_FAILURE() << "made " << folder.path();
  } catch (const pcrb::Error& error) {
    EXPECT_STREQ(error.what(), "TMPDIR: found `/nowhere/tmp`, expected a folder that exists");
  }
  before == nullptr ? unsetenv("TMPDIR") : setenv("TMPDIR", value.c_str(), 1);
}

}  // namespace
}  // namespace pcrb_tools
