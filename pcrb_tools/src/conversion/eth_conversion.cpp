#include <algorithm>
#include <filesystem>
#include <memory>
#include <utility>

#include "conversion/conversion.hpp"
#include "conversion/converters.hpp"
#include "conversion/log_files.hpp"
#include "pcrb_core/error.hpp"

namespace pcrb_tools {
namespace {

using pcrb::EthFrame;
using Poses = std::map<std::uint64_t, pcrb::Transform>;

constexpr const char* kLeicaFile = "pose_scanner_leica.csv";

bool isPoseFile(const LogFile& file) { return file.fileName() == kLeicaFile; }

/// The sequence that the innermost part of a path is named after.
std::string sequenceOf(const LogFile& file) {
  std::string found;
  for (const auto& part : std::filesystem::absolute(file.path()).lexically_normal()) {
    const std::string name = pcrb::ethSequenceName(part.string());
    if (!name.empty()) found = name;
  }
  return found;
}

std::string ethSequenceOf(const EthRequest& request, const LogFile& first_scan) {
  const std::string name = request.sequence.empty() ? sequenceOf(first_scan) : request.sequence;
  if (name.empty()) {
    throw pcrb::InvalidParameter("found no known sequence in the path " + first_scan.path() +
                                 ", expected its name with --sequence");
  }
  return name;
}

/// Scan files of a frame by number.
std::map<std::uint64_t, std::size_t> findEthScans(const LogFiles& files, EthFrame frame) {
  std::map<std::uint64_t, std::size_t> scans;
  for (std::size_t i = 0; i != files.all().size(); ++i) {
    const auto name = pcrb::parseEthScanName(files.all()[i].fileName());
    if (!name || name->frame != frame) continue;
    const auto [place, is_new] = scans.emplace(name->number, i);
    if (!is_new) {
      throw pcrb::InvalidFile(files.all()[i].path(), 0,
                              "the same scan as " + files.all()[place->second].path(),
                              "the files of one sequence");
    }
  }
  return scans;
}

/// The poses, and the file that they are from: empty where there is none.
std::pair<Poses, std::string> findPoses(const LogFiles& files) {
  const auto found = files.find(isPoseFile);
  if (found.empty()) return {};
  for (const std::size_t index : found) {
    if (files.text(index) != files.text(found.front())) {
      throw pcrb::InvalidFile(files.all()[index].path(), 0,
                              "other poses than in " + files.all()[found.front()].path(),
                              "the files of one sequence");
    }
  }
  const std::string path = files.all()[found.front()].path();
  return {pcrb::parseLeicaPoses(files.text(found.front()), path), path};
}

ConvertedScan makeEthCloud(std::string_view bytes, const std::string& path, EthFrame frame,
                           const std::optional<pcrb::Transform>& pose) {
  pcrb::SensorScan scan = pcrb::parseEthScan(bytes, path);
  if (frame == EthFrame::kLocal) return placed(std::move(scan), pose.value());
  pcrb::DatasetCloud cloud;
  cloud.points = std::move(scan.points);
  if (pose) cloud.viewpoint = pcrb::asViewpoint(*pose);
  cloud.is_viewpoint_known = pose.has_value();
  return {{}, std::move(cloud), scan.counts};
}

void noteMissingNumbers(const std::map<std::uint64_t, std::size_t>& scans,
                        const std::string& sequence, Conversion& conversion) {
  const std::uint64_t last = scans.rbegin()->first;
  if (last + 1 != scans.size()) {
    conversion.note("scan numbers go to " + std::to_string(last) + " but there are only " +
                    std::to_string(scans.size()) + " scans");
  }
  for (const auto& published : pcrb::ethSequences()) {
    if (published.name == sequence && published.scan_count != scans.size()) {
      conversion.note("the published sequence has " + std::to_string(published.scan_count) +
                      " scans");
    }
  }
}

/// The scans that are asked for, and their frame.
std::pair<std::map<std::uint64_t, std::size_t>, EthFrame> chooseScans(const LogFiles& files,
                                                                      const EthRequest& request) {
  for (const EthFrame frame : {EthFrame::kGlobal, EthFrame::kLocal}) {
    if (request.frame.value_or(frame) != frame) continue;
    auto scans = findEthScans(files, frame);
    if (!scans.empty()) return {std::move(scans), frame};
  }
  throw pcrb::InvalidFile(request.inputs.front(), 0, "no scan",
                          !request.frame ? "files PointCloudN.csv or Hokuyo_N.csv"
                          : *request.frame == EthFrame::kGlobal ? "files PointCloudN.csv"
                                                                : "files Hokuyo_N.csv");
}

FileScan planEthScan(std::uint64_t number, std::size_t file, EthFrame frame,
                     const std::optional<pcrb::Transform>& T_world_scanner) {
  return {file, pcrb::ethCloudName(number),
          T_world_scanner ? poseText(*T_world_scanner) : "no pose",
          [frame, T_world_scanner](std::string_view bytes, const std::string& path) {
            return makeEthCloud(bytes, path, frame, T_world_scanner);
          }};
}

}  // namespace

ConversionReport convertEth(const EthRequest& request) {
  const LogFiles files(request.inputs, isPoseFile);
  const auto [scans, frame] = chooseScans(files, request);
  const auto [poses, pose_path] = findPoses(files);
  const std::string sequence = ethSequenceOf(request, files.all()[scans.begin()->second]);
  std::vector<FileScan> work;
  std::size_t without_pose = 0;
  for (const auto& [number, file] : scans) {
    const auto pose = poses.find(number);
    if (pose == poses.end()) ++without_pose;
    if (pose == poses.end() && frame == EthFrame::kLocal) {
      throw pcrb::InvalidFile(pose_path.empty() ? files.all()[file].path() : pose_path, 0,
                              "no pose of scan " + std::to_string(number),
                              std::string("one in ") + kLeicaFile);
    }
    work.push_back(
        planEthScan(number, file, frame,
                    pose == poses.end() ? std::optional<pcrb::Transform>() : pose->second));
  }
  Conversion conversion(request, sequence, work.size());
  noteMissingNumbers(scans, sequence, conversion);
  if (without_pose > 0) {
    conversion.note(std::to_string(without_pose) + " scans have no pose in " + kLeicaFile +
                    ": their VIEWPOINT is not set");
  }
  convertFileScans(files, std::move(work), conversion);
  return conversion.finish();
}

}  // namespace pcrb_tools
