#include "server/run_plan.hpp"

#include <filesystem>
#include <set>

#include "pcrb_core/error.hpp"
#include "pcrb_core/io/derived_file.hpp"
#include "pcrb_core/io/file_bytes.hpp"
#include "pcrb_core/problem/problem.hpp"
#include "pcrb_core/problem/selection.hpp"

namespace pcrb {

namespace {

/// The selected problem files; every word of the selection must name at least one.
std::vector<SequenceFiles> selectFiles(const ServerParameters& parameters) {
  const std::vector<SequenceFiles> known = findSequences(parameters.root);
  std::vector<SequenceFiles> selected;
  for (const auto& files : known) {
    for (const Kind kind : parameters.kinds) {
      bool is_named = false;
      for (const auto& word : parameters.sequences)
        is_named |= namesSequence(word, files.data_set, files.sequence);
      if (is_named && files.kind == kind) selected.push_back(files);
    }
  }
  for (const auto& word : parameters.sequences) {
    bool is_used = false;
    for (const auto& files : selected)
      is_used |= namesSequence(word, files.data_set, files.sequence);
    if (is_used) continue;
    std::set<std::string> list;
    for (const auto& files : known) list.insert(files.data_set + "/" + files.sequence);
    std::string text;
    for (const auto& name : list) text += " " + name;
    throw InvalidParameter("~sequences: found `" + word +
                           "`, expected one with problems of the asked"
                           " kind below " +
                           parameters.root + (text.empty() ? ": there is none" : ":" + text));
  }
  return selected;
}

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
  for (auto& problem : readProblemFile(files.problem_file)) {
    ++line;
    PlannedProblem planned;
    planned.key = {files.data_set, files.sequence, files.kind, problem.id};
    planned.data_set = data_set;
    planned.source_path = cloudPath(files, problem.source, line);
    planned.target_path = cloudPath(files, problem.target, line);
    try {
      planned.P = requireRigid(problem.perturbation);
    } catch (const InvalidProblem& error) {
      throw InvalidFile(files.problem_file + ":" + std::to_string(line), error.what());
    }
    planned.problem = std::move(problem);
    plan.push_back(std::move(planned));
  }
}

std::vector<Candidate> candidatesOf(const std::vector<PlannedProblem>& problems) {
  std::vector<Candidate> candidates;
  for (const auto& planned : problems) {
    const ProblemKey& key = planned.key;
    candidates.push_back({key.data_set, key.sequence, key.kind, key.problem_id,
                          planned.problem.source, planned.problem.target});
  }
  return candidates;
}

/// The shard of the subset: shards of one subset are disjoint and together complete.
std::vector<PlannedProblem> select(std::vector<PlannedProblem> problems,
                                   const ServerParameters& parameters) {
  problems = elementsAt(
      problems, drawSubset(candidatesOf(problems), static_cast<std::size_t>(parameters.subset),
                           static_cast<std::uint64_t>(parameters.seed)));
  return elementsAt(problems,
                    takeShard(candidatesOf(problems), static_cast<std::size_t>(parameters.shard),
                              static_cast<std::size_t>(parameters.shards)));
}

}  // namespace

RunPlan makeRunPlan(const ServerParameters& parameters) {
  RunPlan plan;
  std::map<std::string, std::shared_ptr<const Dataset>> data_sets;
  for (const auto& files : selectFiles(parameters)) {
    auto& data_set = data_sets[files.data_set];
    if (!data_set) {
      data_set = std::make_shared<Dataset>(loadDataset(parameters.root, files.data_set));
    }
    addProblems(files, data_set, plan.problems);
    const std::filesystem::path path(files.problem_file);
    const std::string name = files.data_set + "/" + path.filename().string();
    const std::string hash = plan.problem_files[name] = fileHash(files.problem_file);
    const std::string tool = generatorOf(files.problem_file, hash);
    if (!tool.empty()) plan.drawn_by[name] = tool;
  }
  plan.problems = select(plan.problems, parameters);
  if (plan.problems.empty()) {
    throw InvalidParameter("no problem is left: found " + std::to_string(parameters.shards) +
                           " shards, expected no more than there are problems");
  }
  return plan;
}

std::string PlannedProblem::subject() const {
  return key.data_set + "/" + key.sequence + " " + toString(key.kind) + " " + key.problem_id;
}

std::vector<PlannedProblem> inServingOrder(const std::vector<PlannedProblem>& problems,
                                           const Secret& secret) {
  auto ordered = elementsAt(problems, secretOrder(candidatesOf(problems), secret));
  for (std::size_t i = 1; i < ordered.size(); ++i) {
    ordered[i].target_changed = ordered[i].target_path != ordered[i - 1].target_path;
  }
  return ordered;
}

}  // namespace pcrb
