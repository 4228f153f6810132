#include <filesystem>
#include <utility>

#include "conversion/conversion.hpp"
#include "conversion/converters.hpp"
#include "conversion/log_files.hpp"
#include "pcrb_core/datasets/planetary.hpp"
#include "pcrb_core/error.hpp"

namespace pcrb_tools {
namespace {

bool hasExtension(const LogFile& file, const std::string& extension) {
  return std::filesystem::path(file.fileName()).extension() == extension;
}

std::string stemOf(const LogFile& file) { return std::filesystem::path(file.fileName()).stem(); }

/// Files with an extension by their names without it.
std::map<std::string, std::size_t> findByStem(const LogFiles& files, const std::string& extension) {
  std::map<std::string, std::size_t> found;
  for (const std::size_t index :
       files.find([&](const LogFile& file) { return hasExtension(file, extension); })) {
    const LogFile& file = files.all()[index];
    const auto [place, is_new] = found.emplace(stemOf(file), index);
    if (!is_new) {
      throw pcrb::InvalidFile(file.path(), 0,
                              "the same name as " + files.all()[place->second].path(),
                              "the files of one sequence");
    }
  }
  return found;
}

/// `box_met` for `box_met_052`.
std::string setOf(const std::string& stem) {
  const std::size_t underscore = stem.find_last_of('_');
  const bool numbered = underscore != std::string::npos && underscore > 0 &&
                        underscore + 1 < stem.size() &&
                        stem.find_first_not_of("0123456789", underscore + 1) == std::string::npos;
  return numbered ? stem.substr(0, underscore) : std::string();
}

/// The set of all scans, which they must share.
std::string requireOneSet(const LogFiles& files, const std::map<std::string, std::size_t>& scans) {
  const std::string set = setOf(scans.begin()->first);
  for (const auto& [stem, index] : scans) {
    if (setOf(stem).empty() || setOf(stem) != set) {
      throw pcrb::InvalidFile(files.all()[index].path(), 0, "a scan " + stem,
                              "scans of one set, named like box_met_052");
    }
  }
  return set;
}

ConvertedScan makePlanetaryCloud(std::string_view bytes, const std::string& path,
                                 const pcrb::Transform& T_world_sensor, double max_malformed) {
  return placed(pcrb::parsePlanetaryScan(bytes, path, max_malformed), T_world_sensor);
}

}  // namespace

ConversionReport convertPlanetary(const PlanetaryRequest& request) {
  const LogFiles files(request.inputs,
                       [](const LogFile& file) { return hasExtension(file, ".gt"); });
  const auto scans = findByStem(files, ".xyz");
  const auto pose_files = findByStem(files, ".gt");
  if (scans.empty()) {
    throw pcrb::InvalidFile(request.inputs.front(), 0, "no scan", "files .xyz");
  }
  const std::string set = requireOneSet(files, scans);
  std::vector<FileScan> work;
  for (const auto& [stem, index] : scans) {
    const auto pose_file = pose_files.find(stem);
    if (pose_file == pose_files.end()) {
      throw pcrb::InvalidFile(files.all()[index].path(), 0, "no pose", "a file " + stem + ".gt");
    }
    const pcrb::Transform T_world_sensor = pcrb::parsePlanetaryPose(
        files.text(pose_file->second), files.all()[pose_file->second].path());
    work.push_back({index, stem + ".pcd", poseText(T_world_sensor),
                    [T_world_sensor, limit = request.max_malformed](std::string_view bytes,
                                                                    const std::string& path) {
                      return makePlanetaryCloud(bytes, path, T_world_sensor, limit);
                    }});
  }
  Conversion conversion(request, request.sequence.empty() ? set : request.sequence, work.size());
  convertFileScans(files, std::move(work), conversion);
  return conversion.finish();
}

}  // namespace pcrb_tools
