#include <algorithm>
#include <filesystem>
#include <memory>
#include <utility>

#include "archives/bag_messages.hpp"
#include "conversion/converters.hpp"
#include "conversion/kaist_stream.hpp"
#include "conversion/log_files.hpp"
#include "conversion/raw_scans.hpp"
#include "pcrb_core/error.hpp"
#include "pcrb_core/io/number.hpp"

namespace pcrb_tools {
namespace {

namespace fs = std::filesystem;

/// Name of the folder that a file lies in.
std::string folderName(const LogFile& file) {
  return fs::path(file.path()).parent_path().filename().string();
}

/// The scans of one sensor: those that are listed and there, or, without a list, those there.
struct SensorFiles {
  std::map<pcrb::Stamp, std::size_t> scans;
  std::vector<pcrb::Stamp> missing;  ///< listed, but without a file
  std::size_t unlisted = 0;          ///< files that the list does not have
};

std::map<pcrb::Stamp, std::size_t> findVelodyneScans(const LogFiles& files,
                                                     const std::string& folder) {
  std::map<pcrb::Stamp, std::size_t> scans;
  for (std::size_t i = 0; i != files.all().size(); ++i) {
    const LogFile& file = files.all()[i];
    const fs::path name(file.fileName());
    if (name.extension() != ".bin" || folderName(file) != folder) continue;
    const auto stamp = pcrb::parseInt(name.stem().string());
    if (!stamp || *stamp < 0) {
      throw pcrb::InvalidFile(file.path(), 0, "another name", "a stamp in ns and .bin");
    }
    if (!scans.emplace(*stamp, i).second) {
      throw pcrb::InvalidFile(file.path(), 0, "the same scan again", "the files of one sequence");
    }
  }
  return scans;
}

SensorFiles listScans(const LogFiles& files, const std::string& folder) {
  SensorFiles sensor;
  sensor.scans = findVelodyneScans(files, folder);
  const auto lists =
      files.find([&](const LogFile& file) { return file.fileName() == folder + "_stamp.csv"; });
  if (lists.empty()) return sensor;
  std::map<pcrb::Stamp, std::size_t> listed;
  for (const pcrb::Stamp stamp :
       pcrb::parseKaistStamps(files.text(lists.front()), files.all()[lists.front()].path())) {
    const auto found = sensor.scans.find(stamp);
    if (found == sensor.scans.end()) {
      sensor.missing.push_back(stamp);
    } else {
      listed.insert(*found);
    }
  }
  sensor.unlisted = sensor.scans.size() - listed.size();
  sensor.scans = std::move(listed);
  return sensor;
}

std::vector<pcrb::Stamp> stampsOf(const SensorFiles& sensor) {
  std::vector<pcrb::Stamp> stamps;
  for (const auto& [stamp, index] : sensor.scans) stamps.push_back(stamp);
  return stamps;
}

/// One run over a log.
class KaistLog {
 public:
  KaistLog(const KaistRequest& request, const LogFiles& files)
      : request_(request),
        files_(files),
        left_(listScans(files, "VLP_left")),
        right_(listScans(files, "VLP_right")),
        frames_(readFrames(request, &files)) {
    if (left_.scans.empty() || right_.scans.empty()) {
      throw pcrb::InvalidFile(request.inputs.front(), 0,
                              std::to_string(left_.scans.size()) + " left and " +
                                  std::to_string(right_.scans.size()) + " right scans",
                              "files VLP_left/<ns>.bin and VLP_right/<ns>.bin");
    }
  }

  ConversionReport convert() {
    const std::string first = files_.all()[left_.scans.begin()->second].path();
    const std::string sequence = kaistSequence(request_, first);
    Conversion conversion(request_, sequence, left_.scans.size() + left_.missing.size());
    // Shared with the workers, who may outlive this call's variables when it fails.
    const auto spool = std::make_shared<const SpoolFolder>(conversion.folder());
    KaistScanSelector selector(frames_, request_, sequence, conversion);
    noteLists(sequence, conversion);
    const auto work = planPairs(selector, conversion);
    spoolArchived(work, *spool);
    for (const Work& pair : work) {
      conversion.add(pair.pair.cloud_name, [this, spool, pair] {
        auto memory = takeMemoryOfFiles({pathOf(pair.left, *spool), pathOf(pair.right, *spool)});
        ConvertedScan scan = mergePair(frames_, pair.pair, readScan(pair.left, *spool),
                                       readScan(pair.right, *spool));
        scan.memory = std::move(memory);
        return scan;
      });
    }
    return conversion.finish();
  }

 private:
  struct Work {
    KaistScanSelector::Pair pair;
    std::size_t left, right;  ///< files
  };

  void noteLists(const std::string& sequence, Conversion& conversion) const {
    for (const pcrb::Stamp stamp : left_.missing) {
      conversion.drop(pcrb::kaistCloudName(sequence, stamp), "listed, but without a file");
    }
    const auto note = [&conversion](std::size_t count, const char* what) {
      if (count > 0) conversion.note(std::to_string(count) + what);
    };
    note(right_.missing.size(), " right scans are listed, but without a file");
    note(left_.unlisted + right_.unlisted, " files of scans are not listed and were not used");
  }

  std::string identityOf(std::size_t file) const {
    return files_.all()[file].identity + ' ' + files_.all()[file].fileName() + '\n';
  }

  /// The pairs that become clouds and are not there yet.
  std::vector<Work> planPairs(KaistScanSelector& selector, Conversion& conversion) const {
    const auto right_stamps = stampsOf(right_);
    std::vector<Work> work;
    for (const auto& [stamp, left] : left_.scans) {
      const pcrb::Stamp right_stamp = pcrb::closestStamp(right_stamps, stamp);
      auto pair = selector.select(stamp, right_stamp);
      if (!pair) continue;
      const std::size_t right = right_.scans.at(right_stamp);
      const std::string origin = identityOf(left) + identityOf(right) + pair->origin;
      if (conversion.wants(pair->cloud_name, origin)) work.push_back({*pair, left, right});
    }
    return work;
  }

  /// Scans of a pair lie far apart in an archive: those that are needed are put down first.
  void spoolArchived(const std::vector<Work>& work, const SpoolFolder& spool) const {
    std::vector<std::size_t> needed;
    for (const Work& pair : work) {
      needed.push_back(pair.left);
      needed.push_back(pair.right);
    }
    files_.readArchived(needed, [&spool](std::size_t index, const std::string& bytes) {
      spool.write(index, bytes);
    });
  }

  /// Where a scan's bytes are.
  std::string pathOf(std::size_t index, const SpoolFolder& spool) const {
    const LogFile& file = files_.all()[index];
    return file.in_archive ? spool.path(index) : file.path();
  }

  /// Called by workers.
  pcrb::SensorScan readScan(std::size_t index, const SpoolFolder& spool) const {
    const pcrb::FileBytes bytes(pathOf(index, spool));
    return pcrb::parseVelodyneScan(bytes.text(), request_.origin, files_.all()[index].path());
  }

  const KaistRequest& request_;
  const LogFiles& files_;
  SensorFiles left_;
  SensorFiles right_;
  KaistFrames frames_;
};

ConversionReport convertKaistBags(const KaistRequest& request) {
  const BagMessages bags(request.inputs);
  const std::size_t lefts = bags.count({request.left_topic});
  if (lefts == 0 || bags.count({request.right_topic}) == 0) {
    throw pcrb::InvalidFile(request.inputs.front(), 0,
                            "no message on " +
                                (lefts == 0 ? request.left_topic : request.right_topic) +
                                " among " + bags.describeTopics(),
                            "scans of both sensors (--left-topic, --right-topic)");
  }
  const KaistFrames frames = readFrames(request, nullptr);
  const std::string sequence = kaistSequence(request, request.inputs.front());
  Conversion conversion(request, sequence, lefts);
  KaistStream stream(frames, request, sequence, bags.identity(), conversion);
  bags.forEach({request.left_topic, request.right_topic},
               [&](const rosbag::MessageInstance& instance) {
                 const auto cloud = messageAs<sensor_msgs::PointCloud2>(instance);
                 if (instance.getTopic() == request.left_topic) {
                   stream.addLeft(cloud);
                 } else {
                   stream.addRight(cloud);
                 }
               });
  stream.finish();
  return conversion.finish();
}

}  // namespace

ConversionReport convertKaist(const KaistRequest& request) {
  if (areBags(request.inputs)) return convertKaistBags(request);
  const LogFiles files(request.inputs, [](const LogFile& file) {
    const std::string name = file.fileName();
    return isFrameFile(file) || name == "VLP_left_stamp.csv" || name == "VLP_right_stamp.csv";
  });
  return KaistLog(request, files).convert();
}

}  // namespace pcrb_tools
