#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "common/sequence_paths.hpp"
#include "conversion/own_request.hpp"
#include "pcrb_core/problem/dataset.hpp"

namespace pcrb_tools {

/// The logs below `<logs>/{eth,planetary,tum,kaist}`, each by the name of its folder, archive or
/// bag, sorted.
///
/// Of a TUM sequence the bag with clouds is taken if there is one, else the raw bag, else the
/// archive or folder with PNGs; a KAIST sequence is all that is named after it, its bags apart.
/// @throws InvalidFile  if there is no log.
std::vector<SequenceLog> findLogs(const std::string& logs);

/// The stages of a preparation, in their order.
enum class PrepareStage { kConvert, kMap, kOverlap, kProblems, kCheck };

const char* toString(PrepareStage stage);

/// All stages by their names.
std::map<std::string, PrepareStage> prepareStages();

/// What `prepare_dataset` is asked for.
struct PrepareOptions {
  std::string logs;  ///< folder of the original logs
  std::string root;  ///< of the common layout
  /// Data sets, sequences, or `<data set>/<sequence>`; empty or `all` = all
  std::vector<std::string> sequences;
  PrepareStage last = PrepareStage::kCheck;
  std::uint64_t seed = 1;
  pcrb::BoundsSource bounds = pcrb::BoundsSource::kMeasured;
  double kaist_max_rate = 0.0;    ///< Hz; 0 = all scans
  std::size_t window = 150;       ///< pairs so many places apart, in sequences over twice as long
  std::size_t overlap_pairs = 5;  ///< of each problem file, checked
  int threads = 1;
};

/// Prepares data sets: converts the logs, builds the planetary map, computes overlaps, draws
/// problems, checks. What is complete and unchanged is kept, so a run goes on where an earlier one
/// was stopped or killed. Maps, matrices and problem files of somebody else's, e.g. the published
/// ones, are kept and said to be; clouds of somebody else's in a sequence's folder are an error.
///
/// @return  whether the check found no error.
/// @throws pcrb::Error  when a stage fails; what is complete stays.
bool prepareDataset(const PrepareOptions& options, std::ostream& out);

/// What the parameters of a new data set are written from; unset ones are left to the defaults.
struct DatasetParameters {
  std::optional<double> overlap_distance;  ///< m
  std::optional<double> voxel_leaf;        ///< m
  std::string sensor;
};

/// Prepares a sequence of a log of one's own: converts it, writes `dataset.yaml` where there is
/// none, and goes through the stages of prepareDataset(); the map, `<sequence>_map.pcd` beside the
/// folder, is made of the sequence's own clouds, for whoever wants one.
///
/// @param options  logs and sequences are not used
/// @return  whether the check found no error.
/// @throws pcrb::Error  when a stage fails; what is complete stays. InvalidParameter for parameters
///                      that contradict a dataset.yaml which is there.
bool prepareOwn(const OwnRequest& request, const DatasetParameters& parameters,
                const PrepareOptions& options, std::ostream& out);

}  // namespace pcrb_tools
