#include "bridge/answer_diagnosis.hpp"

#include <algorithm>
#include <cmath>

#include "bridge/setup_check.hpp"
#include "pcrb_core/io/number.hpp"

namespace pcrb {

namespace {

constexpr double kBusyShare = 0.5;  // of one processor, above which a silent node is at work
constexpr double kEven = 0.005;     // s by which constant lateness may vary

const char* codeOf(AnswerFault fault) {
  switch (fault) {
    case AnswerFault::kType:
      return "type";
    case AnswerFault::kInvalid:
      return "invalid";
    case AnswerFault::kFrame:
      return "frame";
    case AnswerFault::kStamp:
      break;
  }
  return "stamp";
}

double medianOf(std::vector<double> numbers) {
  const auto middle = numbers.begin() + static_cast<std::ptrdiff_t>(numbers.size() / 2);
  std::nth_element(numbers.begin(), middle, numbers.end());
  return *middle;
}

/// `; poses are published on …`; empty for none.
std::string describe(const std::vector<PoseTopic>& topics) {
  std::string text;
  for (const auto& topic : topics) {
    text += (text.empty() ? "; poses are published on " : ", ") + topic.topic + " (" + topic.type +
            " by " + topic.nodes + ")";
  }
  return text;
}

std::string howToChooseFrom(const std::vector<PoseTopic>& topics) {
  return ": set " + howToSet("pose_topic", topics.empty() ? "TOPIC" : topics.front().topic) +
         ", or pose_topic:=tf if it answers on tf";
}

std::string posesOf(int count) { return std::to_string(count) + (count == 1 ? " pose" : " poses"); }

}  // namespace

void AnswerDiagnosis::note(AnswerFault fault, const std::string& example) {
  Count& count = faults_[fault];
  ++count.poses;
  count.example = example;
}

void AnswerDiagnosis::noteStamp(double lateness) {
  ++faults_[AnswerFault::kStamp].poses;
  lateness_.push_back(lateness);
}

std::string AnswerDiagnosis::describe(AnswerFault fault, const Count& count) const {
  if (fault != AnswerFault::kStamp) return posesOf(count.poses) + ": " + count.example;
  const auto [least, most] = std::minmax_element(lateness_.begin(), lateness_.end());
  const std::string median = formatFixed(medianOf(lateness_), 3);
  const bool is_even = *most - *least <= kEven;
  return posesOf(count.poses) + " with the stamp of no scan, " + median +
         (is_even ? " s later: set " + howToSet("answer_delay", median)
                  : " s later in the median: set " + howToSet("match", "arrival") +
                        ", or answer_delay where the delay is constant");
}

NoAnswerCause AnswerDiagnosis::cause() const {
  const auto most = std::max_element(
      faults_.begin(), faults_.end(),
      [](const auto& a, const auto& b) { return a.second.poses < b.second.poses; });
  NoAnswerCause cause;
  if (most == faults_.end()) return cause;
  cause.code = codeOf(most->first);
  for (const auto& [fault, count] : faults_) {
    cause.text += (cause.text.empty() ? "" : "; ") + describe(fault, count);
  }
  return cause;
}

std::string describeSilence(const std::string& topic, const std::vector<PoseTopic>& others) {
  return "no node publishes " + topic + " (pose_topic) so far" + describe(others) +
         (others.empty() ? "" : howToChooseFrom(others));
}

std::string describeWrongType(const std::string& topic, const std::string& type,
                              const std::vector<PoseTopic>& others) {
  return topic + " (pose_topic): found messages of type " + type +
         ", expected PoseStamped, PoseWithCovarianceStamped, TransformStamped or Odometry" +
         describe(others) + howToChooseFrom(others);
}

std::string adviceOnTopic(const NoAnswerCause& cause, const std::vector<PoseTopic>& others) {
  return cause.text + howToChooseFrom(others);
}

NoAnswerCause causeOf(const Silence& silence, const std::string& scans) {
  const std::string nothing = "the node said nothing to " + scans;
  if (!silence.is_published) {
    const std::string others = describe(silence.other_topics);
    return {"topic", nothing + ": no node publishes " + silence.pose_topic + others};
  }
  const bool is_busy = silence.cpu_time >= 0.0 && silence.cpu_time > kBusyShare * silence.elapsed;
  if (is_busy) {
    return {"busy", nothing + ": it has worked for " + formatFixed(silence.cpu_time, 1) + " s of " +
                        formatFixed(silence.elapsed, 1) + " s: give it more time_limit"};
  }
  return {"silent", nothing + (silence.cpu_time < 0.0
                                   ? ""
                                   : ", and worked for " + formatFixed(silence.cpu_time, 1) +
                                         " s of " + formatFixed(silence.elapsed, 1) +
                                         " s: it may wait for another input or for a processor, or "
                                         "reject its own results; see what it printed")};
}

std::string FailureLog::note(const NoAnswerCause& cause) {
  Count& count = causes_[cause.code];
  ++count.problems;
  count.example = cause.text;
  return count.problems == 2 ? "two problems without an answer, alike: " + cause.text : "";
}

std::string FailureLog::table() const {
  std::vector<std::pair<std::string, Count>> rows(causes_.begin(), causes_.end());
  std::stable_sort(rows.begin(), rows.end(), [](const auto& a, const auto& b) {
    return a.second.problems > b.second.problems;
  });
  std::string text;
  for (const auto& [code, count] : rows) {
    text += "\n  " + std::to_string(count.problems) + " × " + code + ": " + count.example;
  }
  return text.empty() ? "" : "problems without an answer, by cause (the newest as example):" + text;
}

void MisalignmentCheck::add(double error, double initial_misalignment) {
  errors_.push_back(error);
  misalignments_.push_back(initial_misalignment);
}

std::string MisalignmentCheck::warning() const {
  if (errors_.empty()) return "";
  const double error = medianOf(errors_);
  const double misalignment = medianOf(misalignments_);
  if (!(error > misalignment)) return "";
  return "warning: the median error of the node's poses, " + formatFixed(error, 4) +
         ", is worse than that of the initial guesses, " + formatFixed(misalignment, 4) +
         ": is settle right for this node, and are frames and answer_frame?";
}

}  // namespace pcrb
