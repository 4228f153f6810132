#include "bridge/answer_diagnosis.hpp"

#include <gtest/gtest.h>

namespace pcrb {
namespace {

TEST(AnswerDiagnosis, ConstantLatenessSuggestsAnAnswerDelay) {
  AnswerDiagnosis faults;
  for (const double lateness : {0.2, 0.201, 0.199}) faults.noteStamp(lateness);
  EXPECT_EQ(faults.cause().code, "stamp");
  EXPECT_EQ(faults.cause().text,
            "3 poses with the stamp of no scan, 0.200 s later: set `answer_delay: 0.200` in "
            "bridge_parameters");
}

TEST(AnswerDiagnosis, VaryingLatenessSuggestsToMatchByArrival) {
  AnswerDiagnosis faults;
  for (const double lateness : {0.01, 0.05, 0.09}) faults.noteStamp(lateness);
  EXPECT_NE(faults.cause().text.find("0.050 s later in the median: set `match: arrival` in"),
            std::string::npos)
      << faults.cause().text;
}

TEST(AnswerDiagnosis, TheMostFrequentFaultIsTheCodeAndAllAreInTheText) {
  AnswerDiagnosis faults;
  faults.note(AnswerFault::kInvalid, "/pose: found NaN");
  faults.note(AnswerFault::kFrame, "tf does not connect `odom`");
  faults.note(AnswerFault::kFrame, "tf does not connect `world`");
  EXPECT_EQ(faults.cause().code, "frame");
  EXPECT_EQ(faults.cause().text, "1 pose: /pose: found NaN; 2 poses: tf does not connect `world`");
}

TEST(Silence, NamesTheTopicsOnWhichPosesAre) {
  Silence silence;
  silence.is_published = false;
  silence.pose_topic = "/pose";
  silence.other_topics = {{"/ndt_pose", "geometry_msgs/PoseStamped", "/ndt"},
                          {"/odom", "nav_msgs/Odometry", "/ekf"}};
  const NoAnswerCause cause = causeOf(silence, "9 scans");
  EXPECT_EQ(cause.code, "topic");
  EXPECT_EQ(cause.text,
            "the node said nothing to 9 scans: no node publishes /pose; poses are published on "
            "/ndt_pose (geometry_msgs/PoseStamped by /ndt), /odom (nav_msgs/Odometry by /ekf)");
}

TEST(AnswerTopic, IsSaidToBeWrongBeforeTheFirstScanWithWhatToType) {
  const std::vector<PoseTopic> others{{"/ndt_pose", "geometry_msgs/PoseStamped", "/ndt"}};
  EXPECT_EQ(describeSilence("/pose", others),
            "no node publishes /pose (pose_topic) so far; poses are published on /ndt_pose "
            "(geometry_msgs/PoseStamped by /ndt): set pose_topic:=/ndt_pose, or pose_topic:=tf if "
            "it answers on tf");
  EXPECT_EQ(describeSilence("/pose", {}), "no node publishes /pose (pose_topic) so far");
  EXPECT_EQ(describeWrongType("/tf", "tf2_msgs/TFMessage", {}).find("/tf (pose_topic): found"), 0U);
}

TEST(Silence, ANodeThatUsesAProcessorIsBusyAndOneThatDoesNotIsSilent) {
  Silence silence;
  silence.elapsed = 9.0;
  silence.cpu_time = 8.0;
  EXPECT_EQ(causeOf(silence, "9 scans").code, "busy");
  silence.cpu_time = 0.3;
  EXPECT_EQ(causeOf(silence, "9 scans").code, "silent");
  EXPECT_NE(causeOf(silence, "9 scans").text.find("0.3 s of 9.0 s: "), std::string::npos);
  silence.cpu_time = -1.0;
  EXPECT_EQ(causeOf(silence, "9 scans").text, "the node said nothing to 9 scans");
}

TEST(FailureLog, SpeaksAtTheSecondProblemThatFailsAlikeAndCountsAllAtTheEnd) {
  FailureLog log;
  EXPECT_EQ(log.table(), "");
  EXPECT_EQ(log.note({"stamp", "late"}), "");
  EXPECT_EQ(log.note({"silent", "nothing"}), "");
  EXPECT_EQ(log.note({"stamp", "later"}), "two problems without an answer, alike: later");
  EXPECT_EQ(log.note({"stamp", "latest"}), "");
  EXPECT_EQ(log.table(),
            "problems without an answer, by cause (the newest as example):\n"
            "  3 × stamp: latest\n"
            "  1 × silent: nothing");
}

TEST(MisalignmentCheck, WarnsWhereTheMedianErrorIsWorseThanTheInitialGuesses) {
  MisalignmentCheck check;
  EXPECT_EQ(check.warning(), "");
  check.add(0.1, 0.5);
  EXPECT_EQ(check.warning(), "");
  check.add(2.0, 0.4);
  check.add(3.0, 0.6);
  EXPECT_NE(check.warning().find("2.0000, is worse than that of the initial guesses, 0.5000"),
            std::string::npos)
      << check.warning();
}

}  // namespace
}  // namespace pcrb
