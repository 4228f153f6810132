#include "preparation/preparation.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <functional>
#include <iterator>
#include <utility>

#include "common/process.hpp"
#include "conversion/converters.hpp"
#include "conversion/own_log.hpp"
#include "pcrb_core/error.hpp"
#include "pcrb_core/io/derived_file.hpp"
#include "pcrb_core/io/pcd.hpp"
#include "pcrb_core/problem/dataset.hpp"
#include "pcrb_core/problem/pair_sampling.hpp"
#include "preparation/own_parameters.hpp"
#include "preparation/preparation_tools.hpp"

namespace pcrb_tools {
namespace {

namespace fs = std::filesystem;

constexpr const char* kMapDataSet = "planetary";
constexpr const char* kMapSource = "box_met";   ///< sequence that the map is made of
constexpr const char* kMapTarget = "p2at_met";  ///< sequence that is registered against it
constexpr const char* kMapProblems = "planetary_map";

template <typename Request>
Request makeRequest(const SequenceLog& log, const PrepareOptions& options) {
  Request request;
  request.inputs = log.inputs;
  request.root = options.root;
  request.data_set = log.data_set;
  request.sequence = log.sequence;
  request.threads = options.threads;
  return request;
}

ConversionReport convertLog(const SequenceLog& log, const PrepareOptions& options) {
  if (log.data_set == "eth") return convertEth(makeRequest<EthRequest>(log, options));
  if (log.data_set == "tum") return convertTum(makeRequest<TumRequest>(log, options));
  if (log.data_set == "planetary") {
    return convertPlanetary(makeRequest<PlanetaryRequest>(log, options));
  }
  auto request = makeRequest<KaistRequest>(log, options);
  request.max_rate = options.kaist_max_rate;
  return convertKaist(request);
}

/// Whether to leave a file alone because somebody else made it, e.g. a published one.
bool isLeftAlone(const std::string& file, std::ostream& out) {
  if (!pcrb::isForeign(file)) return false;
  out << "kept, as it was there before: " << file << std::endl;
  return true;
}

/// A preparation under way.
class Preparation {
 public:
  using Convert = std::function<ConversionReport(const SequenceLog&)>;

  /// @param convert  of a log of one's own; empty: the published data sets' converters
  Preparation(const PrepareOptions& options, std::vector<SequenceLog> logs, std::ostream& out,
              Convert convert = nullptr)
      : options_(options), logs_(std::move(logs)), out_(out), convert_own_(std::move(convert)) {}

  /// Whether all stages up to the last that is wanted found nothing wrong.
  bool runAll() {
    for (int i = 0; i <= static_cast<int>(options_.last); ++i) {
      const auto stage = static_cast<PrepareStage>(i);
      out_ << "== stage " << i + 1 << " of " << static_cast<int>(options_.last) + 1 << ": "
           << toString(stage) << std::endl;
      if (!run(stage)) return false;
    }
    return true;
  }

 private:
  /// Whether nothing is wrong with what a stage made.
  bool run(PrepareStage stage) {
    if (stage == PrepareStage::kConvert) convert();
    if (stage == PrepareStage::kMap) buildMap();
    if (stage == PrepareStage::kOverlap) computeOverlaps();
    if (stage == PrepareStage::kProblems) sampleProblems();
    return stage != PrepareStage::kCheck || check();
  }

  std::string folder(const std::string& data_set, const std::string& sequence) const {
    return (fs::path(options_.root) / data_set / sequence).string();
  }

  std::string folder(const SequenceLog& log) const { return folder(log.data_set, log.sequence); }

  bool has(const char* sequence) const {
    return std::any_of(logs_.begin(), logs_.end(), [sequence](const auto& log) {
      return log.data_set == kMapDataSet && log.sequence == sequence;
    });
  }

  std::string mapFile() const {
    return (fs::path(folder(kMapDataSet, kMapTarget)) / pcrb::kMapCloud).string();
  }

  std::string mapMatrix() const { return folder(kMapDataSet, kMapProblems) + "_overlap.txt"; }

  bool hasMap() const { return has(kMapTarget) && fs::exists(mapFile()); }

  void convert() {
    for (const auto& log : logs_) {
      const ConversionReport report = convert(log);
      out_ << formatReport(report) << std::flush;
      if (report.others.empty()) continue;
      // The stages to come take all clouds of the folder.
      throw pcrb::InvalidFile(folder(log), 0,
                              std::to_string(report.others.size()) +
                                  " clouds that were not made of this log, the first is " +
                                  report.others.front(),
                              "none; move them away and run again");
    }
  }

  ConversionReport convert(const SequenceLog& log) const {
    if (convert_own_) return convert_own_(log);
    try {
      return convertLog(log, options_);
    } catch (const pcrb::InvalidFile& error) {
      throw pcrb::InvalidFile(log.data_set + "/" + log.sequence,
                              std::string(error.what()) +
                                  "; mend this log, or name the sequences to prepare without it, "
                                  "and run again: what is complete is kept");
    }
  }

  void buildMap() {
    if (convert_own_) {
      buildOwnMap(logs_.front());
      return;
    }
    if (!has(kMapTarget) || isLeftAlone(mapFile(), out_)) return;
    if (!has(kMapSource)) {
      out_ << "no map is built: it needs the log of " << kMapSource << std::endl;
      return;
    }
    buildMap(folder(kMapDataSet, kMapSource), mapFile());
  }

  void buildMap(const std::string& clouds, const std::string& output) const {
    MapOptions map;
    map.folder = clouds;
    map.output = output;
    map.threads = options_.threads;
    runMapTool(map);
  }

  void buildOwnMap(const SequenceLog& log) {
    const std::string output = folder(log) + "_map.pcd";
    if (!isLeftAlone(output, out_)) buildMap(folder(log), output);
  }

  void computeOverlaps() {
    for (const auto& log : logs_) {
      OverlapOptions overlap;
      overlap.folder = folder(log);
      overlap.output = overlap.folder + "_overlap.txt";
      const auto clouds = pcrb::findClouds(overlap.folder);
      if (clouds.size() > 2 * options_.window) overlap.window = options_.window;
      const bool has_map = std::count(clouds.begin(), clouds.end(), pcrb::kMapCloud) > 0;
      if (has_map) overlap.excluded = {pcrb::kMapCloud};  // it is no scan
      computeOverlap(overlap);
    }
    if (!hasMap()) return;
    OverlapOptions with_map;
    with_map.folder = folder(kMapDataSet, kMapTarget);
    with_map.output = mapMatrix();
    with_map.targets = {pcrb::kMapCloud};
    computeOverlap(with_map);
  }

  void computeOverlap(OverlapOptions& overlap) {
    overlap.threads = options_.threads;
    if (!isLeftAlone(overlap.output, out_)) runOverlapTool(overlap);
  }

  void sampleProblems() {
    for (const auto& log : logs_) {
      SamplingOptions sampling;
      sampling.folder = folder(log);
      sampling.sequence = log.sequence;
      sample(sampling);
    }
    if (!hasMap()) return;
    SamplingOptions with_map;
    with_map.folder = folder(kMapDataSet, kMapTarget);
    with_map.sequence = kMapProblems;
    with_map.overlap = mapMatrix();
    with_map.map = pcrb::kMapCloud;
    sample(with_map);
  }

  /// Draws the problems of a sequence, kinds that somebody else made apart.
  void sample(SamplingOptions& sampling) {
    sampling.bounds = options_.bounds;
    sampling.seed = options_.seed;
    sampling.threads = options_.threads;
    sampling.kinds.clear();
    for (const auto kind : {pcrb::Kind::kLocal, pcrb::Kind::kGlobal}) {
      const fs::path file = fs::path(sampling.folder).parent_path() /
                            (sampling.sequence + '_' + pcrb::toString(kind) + ".txt");
      if (!isLeftAlone(file.string(), out_)) sampling.kinds.push_back(kind);
    }
    if (!sampling.kinds.empty()) runSamplingTool(sampling);
  }

  bool check() {
    CheckOptions check;
    check.root = options_.root;
    for (const auto& log : logs_) check.sequences.push_back(log.data_set + '/' + log.sequence);
    if (hasMap()) check.sequences.push_back(std::string(kMapDataSet) + '/' + kMapProblems);
    check.overlap_pairs = options_.overlap_pairs;
    check.threads = options_.threads;
    return runCheckTool(check, out_);
  }

  const PrepareOptions& options_;
  std::vector<SequenceLog> logs_;
  std::ostream& out_;
  Convert convert_own_;
};

/// The logs of the sequences that are asked for, each of which must be there.
std::vector<SequenceLog> selectLogs(const PrepareOptions& options) {
  const std::vector<SequenceLog> logs = findLogs(options.logs);
  std::vector<pcrb::SequenceName> names;
  for (const auto& log : logs) names.push_back({log.data_set, log.sequence});
  std::vector<SequenceLog> selected;
  for (const std::size_t i :
       pcrb::selectNamed(names, options.sequences, [&](const std::string& word) {
         throw pcrb::InvalidParameter("found no log of " + word + " in " + options.logs +
                                      ", expected data sets, sequences, or <data set>/<sequence>");
       })) {
    selected.push_back(logs[i]);
  }
  return selected;
}

}  // namespace

const char* toString(PrepareStage stage) {
  constexpr std::array kNames{"convert", "map", "overlap", "problems", "check"};
  return kNames.at(static_cast<std::size_t>(stage));
}

std::map<std::string, PrepareStage> prepareStages() {
  std::map<std::string, PrepareStage> stages;
  for (int i = 0; i <= static_cast<int>(PrepareStage::kCheck); ++i) {
    const auto stage = static_cast<PrepareStage>(i);
    stages[toString(stage)] = stage;
  }
  return stages;
}

bool prepareDataset(const PrepareOptions& options, std::ostream& out) {
  const Interruption interruption;
  return Preparation(options, selectLogs(options), out).runAll();
}

bool prepareOwn(const OwnRequest& request, const DatasetParameters& parameters,
                const PrepareOptions& options, std::ostream& out) {
  const Interruption interruption;
  const auto convert = [&](const SequenceLog&) {
    ConversionReport report = convertOwn(request);
    settleParameters(request, parameters, out);
    return report;
  };
  const SequenceLog log{request.data_set, sequenceOf(request), request.inputs};
  return Preparation(options, {log}, out, convert).runAll();
}

}  // namespace pcrb_tools
