#include "conversion/tum_conversion.hpp"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "archives/archive_reader.hpp"
#include "conversion/depth_png.hpp"
#include "conversion/file_scans.hpp"
#include "conversion/log_files.hpp"
#include "conversion/pose_text.hpp"
#include "conversion/tum_gate.hpp"
#include "pcrb_core/error.hpp"

namespace pcrb_tools {
namespace {

namespace fs = std::filesystem;

constexpr const char* kListFile = "depth.txt";
constexpr const char* kPoseFile = "groundtruth.txt";
constexpr double kPngUnits = 5000.0;  ///< a metre in the data set's PNGs

bool isBag(const std::string& path) { return fs::path(path).extension() == ".bag"; }

/// The one file with a name.
std::size_t requireOne(const LogFiles& files, const std::string& name) {
  const auto found = files.find([&](const LogFile& file) { return file.fileName() == name; });
  if (found.size() != 1) {
    throw pcrb::InvalidFile(files.all().front().container, 0,
                            std::to_string(found.size()) + " files " + name, "one");
  }
  return found.front();
}

pcrb::Trajectory readTrajectory(const LogFiles& files, const TumRequest& request) {
  if (!request.poses.empty()) {
    return pcrb::parseTumTrajectory(pcrb::FileBytes(request.poses).text(), request.poses);
  }
  const std::size_t index = requireOne(files, kPoseFile);
  return pcrb::parseTumTrajectory(files.text(index), files.all()[index].path());
}

/// The folder of the log: `rgbd_dataset_freiburg3_…`, from inside an archive or from its path.
std::string sequenceName(const TumRequest& request, const LogFile& list) {
  if (!request.sequence.empty()) return request.sequence;
  const std::string path = fs::absolute(list.path()).lexically_normal().parent_path().string();
  std::string name = fs::path(path).filename().string();
  if (isArchiveName(name)) name = name.substr(0, name.find('.'));
  return pcrb::tumSequenceName(name);
}

struct ListedImage {
  pcrb::Stamp stamp;
  std::size_t file;
};

/// The images of the list that are there, by stamp; the others are dropped.
std::vector<ListedImage> findImages(const LogFiles& files, std::size_t list,
                                    Conversion& conversion) {
  const LogFile& list_file = files.all()[list];
  std::map<std::string, std::size_t> by_name;
  for (std::size_t i = 0; i != files.all().size(); ++i) {
    if (files.all()[i].container == list_file.container) by_name.emplace(files.all()[i].name, i);
  }
  std::vector<ListedImage> images;
  for (const auto& image : pcrb::parseTumImageList(files.text(list), list_file.path())) {
    const auto found = by_name.find(list_file.folder() + image.path);
    if (found != by_name.end()) {
      images.push_back({image.stamp, found->second});
    } else {
      conversion.drop(TumGate::cloudName(image.stamp), "listed, but without a file");
    }
  }
  std::stable_sort(images.begin(), images.end(),
                   [](const auto& a, const auto& b) { return a.stamp < b.stamp; });
  return images;
}

FileScan planScan(const ListedImage& image, const pcrb::Transform& T_world_camera,
                  const pcrb::Intrinsics& intrinsics) {
  return {image.file, TumGate::cloudName(image.stamp),
          cameraText(intrinsics, kPngUnits) + poseText(T_world_camera),
          [T_world_camera, intrinsics](std::string_view bytes, const std::string& path) {
            const DepthPng png = decodeDepthPng(bytes, path);
            pcrb::SensorScan scan = pcrb::depthToScan(png.view(kPngUnits), intrinsics, path);
            const pcrb::PointCounts counts = scan.counts;
            return ConvertedScan{pcrb::placeScan(std::move(scan), T_world_camera), counts};
          }};
}

ConversionReport convertImages(const TumRequest& request) {
  const LogFiles files(request.inputs, [](const LogFile& file) {
    return file.fileName() == kListFile || file.fileName() == kPoseFile;
  });
  const std::size_t list = requireOne(files, kListFile);
  const pcrb::Trajectory trajectory = readTrajectory(files, request);
  Conversion conversion(request, sequenceName(request, files.all()[list]), 0);
  noteTrajectory(trajectory, conversion);
  TumGate gate(trajectory, request.options, maxRate(request.options, TumInput::kDepth), conversion);
  const pcrb::Intrinsics intrinsics = request.options.intrinsics.value_or(pcrb::Intrinsics());
  std::vector<FileScan> work;
  for (const auto& image : findImages(files, list, conversion)) {
    if (const auto pose = gate.admit(image.stamp)) {
      work.push_back(planScan(image, *pose, intrinsics));
    }
  }
  convertFileScans(files, std::move(work), conversion);
  return conversion.finish();
}

}  // namespace

ConversionReport convertTum(const TumRequest& request) {
  const auto bags = std::count_if(request.inputs.begin(), request.inputs.end(), isBag);
  if (bags == 0) return convertImages(request);
  if (static_cast<std::size_t>(bags) == request.inputs.size()) return convertTumBags(request);
  throw pcrb::InvalidParameter("found bags together with other inputs, expected bags only or none");
}

}  // namespace pcrb_tools
