#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

/// Why the poses of a node are no answers, for people: a code for each cause, and a sentence.
namespace pcrb {

/// What is wrong with a pose that a node published while it had a problem.
enum class AnswerFault {
  kType,     ///< message of a type that is no pose
  kInvalid,  ///< numbers that are no pose
  kFrame,    ///< in a frame that tf does not connect
  kStamp     ///< with the stamp of no scan
};

/// A cause for which a problem has no answer.
struct NoAnswerCause {
  std::string code;  ///< one word, the same for causes that are alike
  std::string text;
};

/// Counts the poses of one problem that could not be used.
class AnswerDiagnosis {
 public:
  /// @param example  a clause that says what is wrong with the newest such pose.
  void note(AnswerFault fault, const std::string& example);

  /// @param lateness  s from the stamp of the nearest scan before the pose to that of the pose.
  void noteStamp(double lateness);

  bool isEmpty() const { return faults_.empty(); }

  /// The most frequent fault as code; all of them in the text.
  NoAnswerCause cause() const;

 private:
  struct Count {
    int poses = 0;
    std::string example;
  };

  std::string describe(AnswerFault fault, const Count& count) const;

  std::map<AnswerFault, Count> faults_;
  std::vector<double> lateness_;  ///< s
};

/// A topic with poses, and the nodes that publish it.
struct PoseTopic {
  std::string topic;
  std::string type;
  std::string nodes;
};

/// What is known when no pose came at all.
struct Silence {
  bool is_published = true;             ///< whether a node publishes the topic of the answers
  std::string pose_topic;               ///< where none does
  std::vector<PoseTopic> other_topics;  ///< with poses of other nodes
  double elapsed = 0.0;                 ///< s since the first scan was sent
  double cpu_time = -1.0;               ///< s that the node used meanwhile; negative: unknown
};

/// Before the first scan: nobody publishes the topic of the answers, and what to set if a node
/// does elsewhere.
std::string describeSilence(const std::string& topic, const std::vector<PoseTopic>& others);

/// What is published on the topic of the answers is no pose.
std::string describeWrongType(const std::string& topic, const std::string& type,
                              const std::vector<PoseTopic>& others);

/// A cause that ends a run, with what to set.
std::string adviceOnTopic(const NoAnswerCause& cause, const std::vector<PoseTopic>& others);

/// The cause of a silence.
/// @param scans  e.g. `23 scans`.
NoAnswerCause causeOf(const Silence& silence, const std::string& scans);

/// Counts the causes of a run's problems, and says what repeats.
class FailureLog {
 public:
  /// @return  what to tell people now: at the second problem with the same code its text; else
  ///          nothing.
  std::string note(const NoAnswerCause& cause);

  /// A line per cause, most frequent first; empty where there was none.
  std::string table() const;

 private:
  struct Count {
    int problems = 0;
    std::string example;
  };

  std::map<std::string, Count> causes_;
};

/// Warns of a run whose replies are worse than the initial guesses.
class MisalignmentCheck {
 public:
  void add(double error, double initial_misalignment);

  /// Empty where the median of the errors is at most that of the misalignments.
  std::string warning() const;

 private:
  std::vector<double> errors_;
  std::vector<double> misalignments_;
};

}  // namespace pcrb
