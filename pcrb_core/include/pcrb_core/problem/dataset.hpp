#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "pcrb_core/problem/problem.hpp"

namespace pcrb {

struct Range {
  double min = 0.0;
  double max = 0.0;
};

/// Bounds of the magnitude of random perturbations.
struct PerturbationBounds {
  Range translation;   ///< m
  Range rotation_deg;  ///< degrees
};

/// What is the same for all sequences of a data set.
struct Dataset {
  std::string name;
  double overlap_distance = 0.2;  ///< m
  double voxel_leaf = 0.2;        ///< m
  PerturbationBounds local{{0, 3}, {0, 30}};
  PerturbationBounds global{{5, 20}, {45, 180}};
  std::string sensor;                        ///< for the report
  std::vector<std::string> characteristics;  ///< for the report: indoor, outdoor, structured …

  const PerturbationBounds& bounds(Kind kind) const {
    return kind == Kind::kLocal ? local : global;
  }
};

/// Which perturbation bounds the four published data sets have: those measured in the published
/// problem files, or those of upstream's own note (docs/methods.md).
enum class BoundsSource { kMeasured, kNote };

/// Parameters of a data set: built in for eth, planetary, tum and kaist; overridden, key by key, by
/// `<root>/<name>/dataset.yaml` where that file exists; else the defaults of Dataset.
///
/// @throws InvalidFile  with file and line for unknown keys, wrong types and impossible values.
Dataset loadDataset(const std::string& root, const std::string& name,
                    BoundsSource bounds = BoundsSource::kMeasured);

/// Whether it is one of the published data sets, whose parameters are built in.
bool isPublished(const std::string& data_set);

/// One problem file and the folder of its clouds.
struct SequenceFiles {
  std::string data_set;  ///< folder below the root
  std::string sequence;  ///< name of the problem file without its `_local.txt` or `_global.txt`
  Kind kind = Kind::kLocal;
  std::string problem_file;  ///< path
  std::string cloud_folder;  ///< path; `p2at_met` for the sequence `planetary_map`
};

/// All problem files below a root in the common layout, `<root>/<data set>/<sequence>_<kind>.txt`,
/// sorted by data set, sequence, kind.
///
/// @throws InvalidFile  if the root is no readable folder.
std::vector<SequenceFiles> findSequences(const std::string& root);

/// What a sequence is called: unique below a root.
struct SequenceName {
  std::string data_set;
  std::string sequence;
};

/// Whether a word of a selection names a sequence: `all`, the sequence, its data set, or
/// `data_set/sequence`. This is the one rule of all programs.
bool namesSequence(const std::string& word, const SequenceName& name);

/// The sequences that the words of a selection name (namesSequence); all where there are no words.
///
/// @param refuse  called with the first word that names none: throws what is wrong with it.
/// @return        ascending positions in `known`.
std::vector<std::size_t> selectNamed(const std::vector<SequenceName>& known,
                                     const std::vector<std::string>& words,
                                     const std::function<void(const std::string& word)>& refuse);

/// The same of a run, which has words.
///
/// @param known  sequences to choose from.
/// @param place  where the known ones are, for the message: `below /data`, `in the catalog`.
/// @return       ascending positions in `known`.
/// @throws InvalidParameter  with the first word that names none, and the known names.
std::vector<std::size_t> selectSequences(const std::vector<SequenceName>& known,
                                         const std::vector<std::string>& words,
                                         const std::string& place);

/// The problem files below a root that the words of a selection name, of some kinds, in the order
/// of findSequences().
///
/// @throws InvalidFile  as findSequences().
/// @throws InvalidParameter  as selectSequences(), of the sequences that have problems of these
///                           kinds.
std::vector<SequenceFiles> selectProblemFiles(const std::string& root,
                                              const std::vector<std::string>& words,
                                              const std::vector<Kind>& kinds);

}  // namespace pcrb
