#include <filesystem>
#include <map>
#include <optional>
#include <utility>

#include "archives/bag_messages.hpp"
#include "conversion/log_files.hpp"
#include "conversion/own_log.hpp"
#include "pcrb_core/error.hpp"
#include "pcrb_core/io/file_bytes.hpp"
#include "pcrb_core/io/number.hpp"
#include "pcrb_core/io/text.hpp"

namespace pcrb_tools {
namespace {

namespace fs = std::filesystem;

constexpr const char* kTimesFile = "times.txt";

/// A file that could hold the poses of a folder of clouds.
bool isPoseText(const LogFile& file) {
  const std::string ending = fs::path(file.fileName()).extension().string();
  return ending == ".txt" || ending == ".csv" || ending == ".log" || ending == ".tum";
}

std::string stemOfCloud(const std::string& file_name) {
  return fs::path(file_name).stem().string();
}

/// The number at the end of a name: 12 of `cloud_012`.
std::optional<std::uint64_t> numberOf(const std::string& stem) {
  const std::size_t begin = stem.find_last_not_of("0123456789") + 1;
  return pcrb::parseUnsigned(stem.substr(begin));
}

/// A folder of clouds and its poses.
class OwnFiles {
 public:
  explicit OwnFiles(const OwnRequest& request)
      : request_(request),
        files_(request.inputs, isPoseText),
        clouds_(files_.find(
            [](const LogFile& file) { return pcrb::isCloudFileName(file.fileName()); })) {
    for (const LogFile& file : files_.all()) {
      if (!clouds_.empty() || !isBag(file.fileName())) continue;
      throw pcrb::InvalidFile(
          file.path(), 0, "a bag in a folder",
          "it as the input itself, of ROS 1 (rosbags-convert makes one of a bag "
          "of ROS 2)");
    }
    if (clouds_.empty()) {
      throw pcrb::InvalidFile(request.inputs.front(), 0,
                              "no cloud among " + std::to_string(files_.all().size()) + " files",
                              "clouds (.pcd, .ply, .bin, .npy), or a bag of ROS 1");
    }
  }

  ConversionReport convert() {
    const std::optional<pcrb::PoseFile> poses = findPoses();
    Conversion conversion(request_, sequenceOf(request_), clouds_.size());
    for (const std::string& note : notes_) conversion.note(note);
    std::vector<FileScan> work;
    if (!poses) {
      for (std::size_t i = 0; i != clouds_.size(); ++i) work.push_back(planPlaced(clouds_[i]));
    } else {
      conversion.note("poses: " + pose_path_ + " (" + pcrb::toString(poses->format) + ")");
      work = plan(*poses, conversion);
    }
    convertFileScans(files_, std::move(work), conversion);
    return conversion.finish();
  }

 private:
  std::string cloudName(std::size_t i) const { return files_.all()[clouds_[i]].fileName(); }

  std::optional<pcrb::PoseFile> findPoses() {
    if (!request_.poses.empty()) {
      pose_path_ = request_.poses;
      return noted(pcrb::parsePoseFile(pcrb::FileBytes(pose_path_).text(), pose_path_,
                                       request_.pose_format));
    }
    std::vector<std::string> paths;
    std::optional<pcrb::PoseFile> found;
    for (const std::size_t index : files_.find(isPoseText)) {
      auto poses = posesIn(index);
      if (!poses) continue;
      found = std::move(poses);
      paths.push_back(files_.all()[index].path());
    }
    if (paths.size() == 1) {
      pose_path_ = paths.front();
      return noted(std::move(*found));
    }
    if (paths.empty() && request_.in_world) return std::nullopt;
    throw pcrb::InvalidFile(
        request_.inputs.front(), 0,
        paths.empty() ? "no poses" + defects_ : "poses in " + pcrb::joined(paths),
        "one file of poses (--poses), or clouds that are in one frame already "
        "(--in-world)");
  }

  /// Nothing for another text, e.g. a calibration.
  std::optional<pcrb::PoseFile> posesIn(std::size_t index) {
    if (files_.all()[index].fileName() == kTimesFile) return std::nullopt;
    try {
      return pcrb::parsePoseFile(files_.text(index), files_.all()[index].path(),
                                 request_.pose_format);
    } catch (const pcrb::InvalidFile& error) {
      defects_ += std::string("; ") + error.what();
      return std::nullopt;
    }
  }

  pcrb::PoseFile noted(pcrb::PoseFile file) {
    notes_.insert(notes_.end(), file.notes.begin(), file.notes.end());
    return file;
  }

  std::vector<FileScan> plan(const pcrb::PoseFile& poses, Conversion& conversion) {
    if (poses.key == pcrb::PoseKey::kStamp) return planByStamp(poses, conversion);
    requireTimestamps(request_, pose_path_);
    return planByKey(poses, conversion);
  }

  std::vector<FileScan> planByStamp(const pcrb::PoseFile& poses, Conversion& conversion) {
    placement_ = placementBy(poses.trajectory(pose_path_), request_);
    const std::vector<pcrb::Stamp> stamps = stampsOfClouds();
    ScanThinner thinner(request_, conversion);
    conversion.setPoseStamps(placement_.stamps);
    conversion.noteDuplicatePoses(placement_.duplicates);
    std::vector<FileScan> work;
    for (std::size_t i = 0; i != clouds_.size(); ++i) {
      ScanPlace place;
      const pcrb::PoseStatus status = placement_.find(stamps[i], place);
      if (status != pcrb::PoseStatus::kFound) {
        conversion.dropUnposed(cloudName(i), stamps[i], pcrb::toString(status));
      } else if (thinner.keep(cloudName(i), stamps[i], place.T_world_sensor)) {
        work.push_back(planScan(clouds_[i], place, stamps[i]));
      }
    }
    return work;
  }

  /// By `--times` or a file times.txt, a line a cloud, else by the clouds' names.
  std::vector<pcrb::Stamp> stampsOfClouds() const {
    std::vector<pcrb::Stamp> stamps;
    const auto found =
        files_.find([](const LogFile& file) { return file.fileName() == kTimesFile; });
    if (!request_.times.empty()) {
      stamps = parseTimes(pcrb::FileBytes(request_.times).text(), request_.times);
    } else if (found.size() == 1) {
      stamps = parseTimes(files_.text(found.front()), files_.all()[found.front()].path());
    } else {
      for (std::size_t i = 0; i != clouds_.size(); ++i) stamps.push_back(requireStampInName(i));
    }
    return stamps;
  }

  std::vector<pcrb::Stamp> parseTimes(std::string_view text, const std::string& path) const {
    std::vector<pcrb::Stamp> stamps;
    pcrb::LineReader reader(text, path);
    std::string_view line;
    while (reader.nextDataRow(line)) {
      const auto stamp = pcrb::parseTimestamp(line);
      if (!stamp) reader.fail(pcrb::inQuotes(line), "a timestamp in seconds");
      stamps.push_back(*stamp);
    }
    if (stamps.size() != clouds_.size()) {
      throw pcrb::InvalidFile(path, 0, std::to_string(stamps.size()) + " timestamps",
                              std::to_string(clouds_.size()) +
                                  ", one for each cloud in the order "
                                  "of their names");
    }
    return stamps;
  }

  pcrb::Stamp requireStampInName(std::size_t i) const {
    if (const auto stamp = pcrb::stampOfFileName(cloudName(i))) return *stamp;
    throw pcrb::InvalidFile(files_.all()[clouds_[i]].path(), 0, "a name without a timestamp",
                            "SECONDS.NANOSECONDS or 19 digits in ns, as the poses of " +
                                pose_path_ +
                                " have timestamps (or a line for each cloud: --times)");
  }

  std::vector<FileScan> planByKey(const pcrb::PoseFile& poses, Conversion& conversion) const {
    const std::vector<const pcrb::FilePose*> found =
        poses.key == pcrb::PoseKey::kName ? findByName(poses) : findByIndex(poses);
    conversion.noteDuplicatePoses(poses.duplicates());
    ScanThinner thinner(request_, conversion);
    std::vector<FileScan> work;
    for (std::size_t i = 0; i != clouds_.size(); ++i) {
      if (found[i] == nullptr) {
        conversion.drop(cloudName(i), "without a pose");
        continue;
      }
      ScanPlace place;
      place.T_world_sensor =
          found[i]->T_world_body * request_.T_body_sensor.value_or(pcrb::Transform::Identity());
      if (!request_.in_world) place.T_world_cloud = place.T_world_sensor;
      if (thinner.keep(cloudName(i), std::nullopt, place.T_world_sensor)) {
        work.push_back(planScan(clouds_[i], place, 0));
      }
    }
    return work;
  }

  /// The pose of each cloud; null where there is none.
  std::vector<const pcrb::FilePose*> findByName(const pcrb::PoseFile& poses) const {
    std::map<std::string, const pcrb::FilePose*> by_stem;
    for (const pcrb::FilePose& pose : poses.poses) {
      by_stem[stemOfCloud(fs::path(pose.name).filename().string())] = &pose;
    }
    std::vector<const pcrb::FilePose*> found;
    for (std::size_t i = 0; i != clouds_.size(); ++i) {
      const auto pose = by_stem.find(stemOfCloud(cloudName(i)));
      found.push_back(pose == by_stem.end() ? nullptr : pose->second);
    }
    return found;
  }

  /// By the numbers in the clouds' names if all of them have a pose, else, of as many clouds as
  /// poses, by their order.
  std::vector<const pcrb::FilePose*> findByIndex(const pcrb::PoseFile& poses) const {
    std::map<std::size_t, const pcrb::FilePose*> by_index;
    for (const pcrb::FilePose& pose : poses.poses) by_index[pose.index] = &pose;
    std::vector<const pcrb::FilePose*> found;
    for (std::size_t i = 0; i != clouds_.size(); ++i) {
      const auto number = numberOf(stemOfCloud(cloudName(i)));
      const auto pose = number ? by_index.find(*number) : by_index.end();
      if (pose == by_index.end()) break;
      found.push_back(pose->second);
    }
    if (found.size() == clouds_.size()) return found;
    if (by_index.size() != clouds_.size()) {
      throw pcrb::InvalidFile(pose_path_, 0,
                              std::to_string(by_index.size()) + " poses without timestamps for " +
                                  std::to_string(clouds_.size()) + " clouds",
                              "as many, or the poses' numbers (from " +
                                  std::to_string(by_index.begin()->first) +
                                  ") at the end of the clouds' names");
    }
    found.clear();
    for (const auto& [index, pose] : by_index) found.push_back(pose);
    return found;
  }

  FileScan planScan(std::size_t file, const ScanPlace& place, pcrb::Stamp stamp) const {
    return {file, stemOfCloud(files_.all()[file].fileName()) + ".pcd",
            originText(request_, placement_, place),
            [this, place, stamp](std::string_view bytes, const std::string& path) {
              return placeOwnScan(request_, placement_, place, stamp,
                                  pcrb::parseCloudFile(bytes, path, request_.files), path);
            }};
  }

  /// A cloud that is where it belongs, with the viewpoint that it has.
  FileScan planPlaced(std::size_t file) const {
    return {file, stemOfCloud(files_.all()[file].fileName()) + ".pcd",
            originText(request_, placement_, {}) + " as it is",
            [this](std::string_view bytes, const std::string& path) {
              pcrb::SensorScan scan = pcrb::parseCloudFile(bytes, path, request_.files);
              ConvertedScan converted;
              converted.counts = scan.counts;
              converted.cloud.points = std::move(scan.points);
              converted.cloud.viewpoint = scan.viewpoint;
              converted.cloud.is_viewpoint_known = scan.is_viewpoint_known;
              converted.cloud.notes = std::move(scan.notes);
              return converted;
            }};
  }

  const OwnRequest& request_;
  LogFiles files_;
  std::vector<std::size_t> clouds_;
  std::string pose_path_;
  Placement placement_;
  std::vector<std::string> notes_;
  std::string defects_;  ///< why texts are no poses
};

}  // namespace

ConversionReport convertOwnFiles(const OwnRequest& request) { return OwnFiles(request).convert(); }

}  // namespace pcrb_tools
