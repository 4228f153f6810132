#include <algorithm>
#include <filesystem>
#include <utility>

#include "archives/archive_reader.hpp"
#include "archives/bag_messages.hpp"
#include "conversion/conversion.hpp"
#include "conversion/converters.hpp"
#include "conversion/log_files.hpp"
#include "conversion/raw_scans.hpp"
#include "conversion/tum_stream.hpp"
#include "pcrb_core/datasets/pose_file.hpp"
#include "pcrb_core/error.hpp"
#include "pcrb_core/io/file_bytes.hpp"

namespace pcrb_tools {
namespace {

namespace fs = std::filesystem;

constexpr const char* kCloudsSuffix = "-2hz-with-pointclouds";

/// `…/rgbd_dataset_freiburg2_pioneer_slam` for `….bag` and `…-2hz-with-pointclouds.bag`.
std::string logPath(const std::string& bag) {
  std::string path = fs::path(bag).replace_extension().string();
  const std::size_t suffix = path.rfind(kCloudsSuffix);
  if (suffix != std::string::npos) path.resize(suffix);
  return path;
}

std::string posePath(const TumRequest& request) {
  if (!request.poses.empty()) return request.poses;
  const std::string log = logPath(request.inputs.front());
  const std::string beside = log + "-groundtruth.txt";
  if (!fs::exists(beside)) {
    throw pcrb::InvalidFile(beside, 0, "nothing", "the ground truth (or give its file: --poses)");
  }
  return beside;
}

void convertClouds(const TumOptions& options, const BagMessages& bags, TumStream& stream) {
  bags.forEach({options.cloud_topic}, [&stream](const rosbag::MessageInstance& message) {
    stream.addCloud(messageAs<sensor_msgs::PointCloud2>(message));
  });
}

void convertDepth(const TumOptions& options, const BagMessages& bags, TumStream& stream) {
  // All cameras first: they must agree before an image is converted.
  bags.forEach({options.info_topic}, [&stream](const rosbag::MessageInstance& message) {
    stream.setCamera(*messageAs<sensor_msgs::CameraInfo>(message));
  });
  if (!stream.hasCamera()) {
    throw pcrb::InvalidFile("topic " + options.info_topic, 0,
                            "no message among " + bags.describeTopics(),
                            "the camera (--info-topic, or give fx fy cx cy: --intrinsics)");
  }
  bags.forEach({options.depth_topic}, [&stream](const rosbag::MessageInstance& message) {
    stream.addDepth(messageAs<sensor_msgs::Image>(message));
  });
}

/// What to read, settled for kAuto.
TumInput chooseInput(const TumOptions& options, const BagMessages& bags) {
  if (options.input != TumInput::kAuto) return options.input;
  return bags.count({options.cloud_topic}) > 0 ? TumInput::kClouds : TumInput::kDepth;
}

constexpr const char* kListFile = "depth.txt";
constexpr const char* kGroundTruthFile = "groundtruth.txt";
constexpr double kPngUnits = 5000.0;  ///< a metre in the data set's PNGs

/// The folder of the log: `rgbd_dataset_freiburg3_…`, from inside an archive or from its path.
std::string tumSequenceOf(const TumRequest& request, const LogFile& list) {
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
      conversion.drop(TumScanSelector::cloudName(image.stamp), "listed, but without a file");
    }
  }
  std::stable_sort(images.begin(), images.end(),
                   [](const auto& a, const auto& b) { return a.stamp < b.stamp; });
  return images;
}

FileScan planImage(const ListedImage& image, const pcrb::Transform& T_world_camera,
                   const pcrb::Intrinsics& intrinsics) {
  return {image.file, TumScanSelector::cloudName(image.stamp),
          cameraText(intrinsics, kPngUnits) + poseText(T_world_camera),
          [T_world_camera, intrinsics](std::string_view bytes, const std::string& path) {
            const DepthPng png = decodeDepthPng(bytes, path);
            return placed(pcrb::depthToScan(png.view(kPngUnits), intrinsics, path), T_world_camera);
          }};
}

ConversionReport convertImages(const TumRequest& request) {
  const LogFiles files(request.inputs, [](const LogFile& file) {
    return file.fileName() == kListFile || file.fileName() == kGroundTruthFile;
  });
  const std::size_t list = files.findOne(kListFile);
  const auto [trajectory, notes] = parseChosen(request.poses, &files, kGroundTruthFile,
                                               [](std::string_view text, const std::string& path) {
                                                 return pcrb::parseTrajectory(text, path);
                                               });
  Conversion conversion(request, tumSequenceOf(request, files.all()[list]), 0);
  announcePoses(trajectory, conversion, notes);
  TumScanSelector selector(trajectory, request.options, maxRate(request.options, TumInput::kDepth),
                           conversion);
  const pcrb::Intrinsics intrinsics = request.options.intrinsics.value_or(pcrb::Intrinsics());
  std::vector<FileScan> work;
  for (const auto& image : findImages(files, list, conversion)) {
    if (const auto pose = selector.select(image.stamp)) {
      work.push_back(planImage(image, *pose, intrinsics));
    }
  }
  convertFileScans(files, std::move(work), conversion);
  return conversion.finish();
}

ConversionReport convertTumBags(const TumRequest& request) {
  const BagMessages bags(request.inputs);
  const std::string poses = posePath(request);
  const auto [trajectory, notes] = pcrb::parseTrajectory(pcrb::FileBytes(poses).text(), poses);
  const TumInput input = chooseInput(request.options, bags);
  const std::string topic =
      input == TumInput::kClouds ? request.options.cloud_topic : request.options.depth_topic;
  const std::size_t total = bags.count({topic});
  if (total == 0) {
    throw pcrb::InvalidFile(request.inputs.front(), 0,
                            "no message on " + topic + " among " + bags.describeTopics(),
                            "clouds or depth images (--cloud-topic, --depth-topic)");
  }
  const std::string log_name = fs::path(logPath(request.inputs.front())).filename().string();
  Conversion conversion(
      request, request.sequence.empty() ? pcrb::tumSequenceName(log_name) : request.sequence,
      total);
  announcePoses(trajectory, conversion, notes);
  TumStream stream(trajectory, request.options, input, bags.identity(), conversion);
  if (input == TumInput::kClouds) {
    convertClouds(request.options, bags, stream);
  } else {
    convertDepth(request.options, bags, stream);
  }
  return conversion.finish();
}

}  // namespace

ConversionReport convertTum(const TumRequest& request) {
  return areBags(request.inputs) ? convertTumBags(request) : convertImages(request);
}

}  // namespace pcrb_tools
