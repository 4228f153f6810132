#include "pcrb_core/run/run_plan.hpp"

#include <filesystem>
#include <utility>

#include "pcrb_core/error.hpp"
#include "pcrb_core/io/derived_file.hpp"
#include "pcrb_core/io/file_bytes.hpp"
#include "pcrb_core/io/number.hpp"
#include "pcrb_core/problem/problem.hpp"
#include "run/selection.hpp"

namespace pcrb {

namespace {

std::string cloudPath(const SequenceFiles& files, const std::string& name, std::size_t line) {
  const std::string path = files.cloud_folder + "/" + name;
  if (std::filesystem::is_regular_file(path)) return path;
  throw InvalidFile(files.problem_file, line,
                    "the cloud `" + name + "`, which is no file in " + files.cloud_folder,
                    "a cloud of the sequence");
}

void addProblems(const SequenceFiles& files, const std::shared_ptr<const Dataset>& data_set,
                 std::vector<PlannedProblem>& plan) {
  std::size_t line = 1;
  for (const Problem& problem : readProblemFile(files.problem_file)) {
    plan.push_back(planProblem(files, problem, ++line, data_set));
  }
}

/// The shard of the subset: shards of one subset are disjoint and together complete.
std::vector<PlannedProblem> select(std::vector<PlannedProblem> problems,
                                   const ProblemSelection& selection) {
  problems = elementsAt(problems, drawSubset(problems, selection.subset, selection.seed));
  return elementsAt(problems, selectShard(problems, selection.shard.index, selection.shard.count));
}

/// Notes what a problem file is: its hash, and the tool that drew it.
void noteFile(const SequenceFiles& files, RunPlan& plan) {
  const std::filesystem::path path(files.problem_file);
  const std::string name = files.data_set + "/" + path.filename().string();
  const std::string hash = plan.problem_files[name] = fileHash(files.problem_file);
  const std::string tool = generatorOf(files.problem_file, hash);
  if (!tool.empty()) plan.drawn_by[name] = tool;
}

}  // namespace

std::string toString(const ShardNumber& shard) {
  return std::to_string(shard.index) + "/" + std::to_string(shard.count);
}

ShardNumber shardFromString(const std::string& text) {
  constexpr std::uint64_t kMaxShards = 1000000;
  const std::size_t slash = text.find('/');
  const auto index = parseUnsigned(text.substr(0, slash));
  const auto count =
      slash == std::string::npos ? std::nullopt : parseUnsigned(text.substr(slash + 1));
  if (!index || !count || *index >= *count || *count > kMaxShards) {
    throw InvalidParameter("shard: found `" + text + "`, expected i/N with 0 <= i < N");
  }
  return {static_cast<std::size_t>(*index), static_cast<std::size_t>(*count)};
}

PlannedProblem planProblem(const SequenceFiles& files, const Problem& problem, std::size_t line,
                           std::shared_ptr<const Dataset> data_set) {
  PlannedProblem planned;
  planned.key = {files.data_set, files.sequence, files.kind, problem.id};
  planned.problem = problem;
  planned.data_set = std::move(data_set);
  planned.source_path = cloudPath(files, problem.source, line);
  planned.target_path = cloudPath(files, problem.target, line);
  try {
    planned.P = requireRigid(problem.perturbation);
  } catch (const InvalidProblem& error) {
    throw InvalidFile(files.problem_file + ":" + std::to_string(line), error.what());
  }
  return planned;
}

RunPlan makeRunPlan(const ProblemSelection& selection) {
  RunPlan plan;
  std::map<std::string, std::shared_ptr<const Dataset>> data_sets;
  for (const auto& files :
       selectProblemFiles(selection.root, selection.sequences, selection.kinds)) {
    auto& data_set = data_sets[files.data_set];
    if (!data_set) {
      data_set = std::make_shared<Dataset>(loadDataset(selection.root, files.data_set));
    }
    plan.voxel_leaves[files.data_set] = formatShortest(data_set->voxel_leaf);
    addProblems(files, data_set, plan.problems);
    noteFile(files, plan);
  }
  plan.problems = select(plan.problems, selection);
  if (plan.problems.empty()) {
    throw InvalidParameter("no problem is left: found " + std::to_string(selection.shard.count) +
                           " shards, expected no more than there are problems");
  }
  return plan;
}

std::map<ProblemKey, PlannedProblem> problemsByKey(const RunPlan& plan) {
  std::map<ProblemKey, PlannedProblem> problems;
  for (const PlannedProblem& planned : plan.problems) problems.emplace(planned.key, planned);
  return problems;
}

std::vector<PlannedProblem> inServingOrder(const std::vector<PlannedProblem>& problems,
                                           const Secret& secret) {
  auto ordered = elementsAt(problems, secretOrder(problems, secret));
  for (std::size_t i = 1; i < ordered.size(); ++i) {
    ordered[i].target_changed = ordered[i].target_path != ordered[i - 1].target_path;
  }
  return ordered;
}

}  // namespace pcrb
