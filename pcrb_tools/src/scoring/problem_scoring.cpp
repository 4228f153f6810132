#include <filesystem>
#include <map>
#include <optional>
#include <set>

#include "bags/problem_key.hpp"
#include "common/progress.hpp"
#include "common/sequence_paths.hpp"
#include "pcrb_core/error.hpp"
#include "pcrb_core/io/file_bytes.hpp"
#include "pcrb_core/problem/problem.hpp"
#include "pcrb_core/run/offline_run.hpp"
#include "scoring/quaternion_order.hpp"
#include "scoring/recorded_poses.hpp"
#include "scoring/scoring_tool.hpp"

namespace pcrb_tools {
namespace {

using Replies = std::map<std::string, pcrb::OfflineReply>;

/// The official id that a pose's label or stamp means.
class ProblemNames {
 public:
  ProblemNames(const std::string& problem_file, const std::optional<ProblemKey>& key) {
    for (const pcrb::Problem& problem : pcrb::readProblemFile(problem_file)) {
      ids_.insert(problem.id);
    }
    if (!key) return;
    for (const auto& [stamp, row] : key->rows) {
      by_stamp_[stamp] = row.official_id;
      by_public_id_[row.public_id] = row.official_id;
    }
  }

  std::optional<std::string> find(const RecordedPose& pose) const {
    if (ids_.count(pose.label) > 0) return pose.label;
    const auto by_id = by_public_id_.find(pose.label);
    if (by_id != by_public_id_.end()) return by_id->second;
    const auto stamp = pose.label.empty() ? pose.stamp : pcrb::parseTimestamp(pose.label);
    const auto by_stamp = stamp ? by_stamp_.find(*stamp) : by_stamp_.end();
    if (by_stamp != by_stamp_.end()) return by_stamp->second;
    return std::nullopt;
  }

  /// Of a pose that find() finds nothing for.
  [[noreturn]] void refuse(const RecordedPose& pose) const {
    const std::string what = pose.label.empty() ? pcrb::formatStamp(pose.stamp) : pose.label;
    throw pcrb::InvalidFile(pose.place, 0, "`" + what + "`",
                            by_stamp_.empty() ? "the id of a problem (timestamps need --key)"
                                              : "the id or timestamp of a problem");
  }

 private:
  std::set<std::string> ids_;
  std::map<std::string, std::string> by_public_id_;
  std::map<pcrb::Stamp, std::string> by_stamp_;
};

/// Of a text, each pose must be the only one of a problem.
Replies assignText(const std::vector<RecordedPose>& poses, const ProblemNames& names) {
  Replies replies;
  for (const RecordedPose& pose : poses) {
    const auto id = names.find(pose);
    if (!id) names.refuse(pose);
    if (replies.emplace(*id, pose.reply).second) continue;
    throw pcrb::InvalidFile(pose.place, 0, "another pose of problem " + *id, "one");
  }
  return replies;
}

/// Of a bag, an estimator's answers to one scan may follow each other, and poses between the scans
/// come in between: the last one counts, and those of no problem are counted on a stream.
Replies assignBag(const std::vector<RecordedPose>& poses, const ProblemNames& names,
                  std::ostream& out) {
  Replies replies;
  std::size_t ignored = 0;
  for (const RecordedPose& pose : poses) {
    const auto id = names.find(pose);
    if (id) {
      replies.insert_or_assign(*id, pose.reply);
    } else {
      ++ignored;
    }
  }
  if (replies.empty()) names.refuse(poses.front());
  if (ignored > 0) {
    out << ignored << (ignored == 1 ? " pose" : " poses") << " at other times ignored" << std::endl;
  }
  return replies;
}

ProblemKey readKeyOf(const ProblemFilePath& path, const std::string& key_path) {
  namespace fs = std::filesystem;
  const ProblemKey key = readProblemKey(key_path);
  const std::string name = fs::path(path.files.problem_file).filename().string();
  if (key.problem_file != name || key.hash != pcrb::fileHash(path.files.problem_file)) {
    throw pcrb::InvalidFile(key_path, 0, "the key of another " + key.problem_file,
                            "one of " + path.files.problem_file);
  }
  return key;
}

pcrb::OfflineRunOptions makeRunOptions(const ProblemScoringOptions& options,
                                       const ProblemFilePath& path,
                                       const std::optional<ProblemKey>& key) {
  pcrb::OfflineRunOptions run;
  pcrb::ProblemSelection& selection = run.configuration.selection;
  selection.root = path.root;
  selection.sequences = {path.files.data_set + "/" + path.files.sequence};
  selection.kinds = {path.files.kind};
  selection.subset = key ? key->subset : options.subset;
  selection.seed = key ? key->seed : options.seed;
  run.run = options.run;
  run.client = "score_poses " + std::filesystem::path(options.poses.path).filename().string() +
               " " + pcrb::fileHash(options.poses.path);
  if (!key) {
    run.pose_frame = options.pose_frame;
    return run;
  }
  run.configuration.presentation = key->presentation;
  run.secret = key->secret;
  return run;
}

/// Of replies that are quaternions, held against the perturbations that they should undo.
std::string orderHintOf(const Replies& replies, const std::string& problem_file) {
  std::vector<ReadRotation> rotations;
  for (const pcrb::Problem& problem : pcrb::readProblemFile(problem_file)) {
    const auto reply = replies.find(problem.id);
    if (reply == replies.end() || !reply->second.defect.empty()) continue;
    const Eigen::Quaterniond& q = reply->second.submission.orientation;
    if (!(q.norm() > 0.5)) continue;
    rotations.push_back(
        {pcrb::nearestRotation(problem.perturbation.leftCols<3>()).transpose(), q.normalized()});
  }
  return orderHint(rotations);
}

}  // namespace

void runProblemScoring(const ProblemScoringOptions& options, std::ostream& out) {
  const ProblemFilePath path = splitProblemFilePath(options.problem_file);
  std::optional<ProblemKey> key;
  if (!options.key.empty()) key = readKeyOf(path, options.key);
  const auto poses = readPoses(options.poses.path, options.poses.topic, options.poses.map_frame);
  const ProblemNames names(path.files.problem_file, key);
  const Replies replies =
      options.poses.topic.empty() ? assignText(poses, names) : assignBag(poses, names, out);
  pcrb::OfflineRun run(makeRunOptions(options, path, key));
  Progress progress(path.files.sequence, "problems", run.size());
  const std::string summary = run.score(replies, [&progress] { progress.add(); });
  progress.finish();
  out << summary;
  const std::string hint = key ? std::string() : orderHintOf(replies, path.files.problem_file);
  if (!hint.empty()) out << "note: " << hint << '\n';
  out << std::flush;
}

}  // namespace pcrb_tools
