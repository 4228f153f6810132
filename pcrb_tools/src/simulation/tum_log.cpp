#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "pcrb_core/datasets/stamp.hpp"
#include "pcrb_core/io/number.hpp"
#include "pcrb_core/parallel.hpp"
#include "simulation/depth_camera.hpp"
#include "simulation/noise.hpp"
#include "simulation/props.hpp"
#include "simulation/sample_logs.hpp"
#include "tum_bag.hpp"

namespace pcrb_tools::simulation {
namespace {

using Eigen::AngleAxisd;
using Eigen::Vector3d;

constexpr double kCloudRate = 2.0;       // Hz
constexpr double kTrackingRate = 100.0;  // Hz, of the motion capture system

/// A recording: the way of the camera and what is written of it.
struct TumSequence {
  std::string name;       ///< of the files, without suffix
  std::string published;  ///< of the sequence in the common layout
  Motion T_world_camera;
  bool clouds;            ///< bag with clouds at 2 Hz, else raw bag with depth images
  std::int64_t clock_ns;  ///< Unix time of the start
};

/// Optical frame at a place, looking at a target.
pcrb::Transform lookAt(const Vector3d& position, const Vector3d& target) {
  const Vector3d ahead = (target - position).normalized();
  const Vector3d right = ahead.cross(Vector3d::UnitZ()).normalized();
  pcrb::Transform pose = pcrb::Transform::Identity();
  pose.linear() << right, ahead.cross(right), ahead;
  pose.translation() = position;
  return pose;
}

/// Held in the hand, walked around the desks; the hand trembles.
pcrb::Transform handHeld(double time) {
  const double angle = -1.75 + 0.13 * time;
  const double radius = 1.75 + 0.12 * std::sin(0.7 * time);
  const Vector3d position(radius * std::cos(angle), radius * std::sin(angle),
                          1.32 + 0.08 * std::sin(0.9 * time));
  const Vector3d target(0.30 * std::cos(angle + 0.8), 0.30 * std::sin(angle + 0.8),
                        0.78 + 0.06 * std::sin(0.5 * time));
  pcrb::Transform pose = lookAt(position, target);
  pose.translate(0.004 *
                 Vector3d(std::sin(17.0 * time), std::sin(23.0 * time), std::sin(13.0 * time)));
  pose.rotate(
      AngleAxisd(0.05 * std::sin(1.1 * time) + 0.004 * std::sin(19.0 * time), Vector3d::UnitZ()));
  return pose;
}

/// On a small robot that drives up and down along the shelves and looks about.
pcrb::Transform onRobot(double time) {
  const Vector3d position(-0.4 + 1.8 * std::sin(0.1 * time - 0.9),
                          1.25 + 0.06 * std::sin(0.3 * time), 0.66);
  const double heading = 1.05 + 0.25 * std::sin(0.5 * time);
  const Vector3d ahead(std::cos(heading), std::sin(heading), -0.14 + 0.02 * std::sin(2.3 * time));
  return lookAt(position, position + ahead);
}

std::vector<TumSequence> tumPlans() {
  return {
      {"rgbd_dataset_freiburg2_pioneer_slam", "pioneer_slam", onRobot, true, 1311877977413521548},
      {"rgbd_dataset_freiburg3_long_office_household", "long_office_household", handHeld, false,
       1341847980722988141}};
}

double duration(const LogOptions& options) { return options.size.tum_clouds / kCloudRate; }

int frameCount(const TumSequence& sequence, const LogOptions& options) {
  if (sequence.clouds) return options.size.tum_clouds;
  return static_cast<int>(duration(options) * options.size.tum_depth_rate);
}

/// Stamp of a frame in ns since the start: the camera's clock is its own and shakes a little.
std::int64_t frameStamp(const TumSequence& sequence, int frame, const LogOptions& options) {
  pcrb::Random random =
      makeStream(options.seed, sequence.name + " stamp", static_cast<std::uint64_t>(frame));
  const double rate = sequence.clouds ? kCloudRate : options.size.tum_depth_rate;
  return static_cast<std::int64_t>((0.2 + frame / rate + random.uniform(-4e-4, 4e-4)) * 1e9);
}

/// When the tracking system lost the camera: from and for how long, s; longer than a cloud's
/// interval, so that one cloud has no ground truth.
constexpr double kLostFrom = 1.45;
constexpr double kLostFor = 0.55;

void appendPose(std::string& text, double stamp, const pcrb::Transform& pose, bool negative) {
  Eigen::Quaterniond q(pose.linear());
  if (negative) q.coeffs() = -q.coeffs();
  pcrb::appendFixed(text, stamp, 4);
  for (const double value : {pose.translation().x(), pose.translation().y(), pose.translation().z(),
                             q.x(), q.y(), q.z(), q.w()}) {
    text += ' ';
    pcrb::appendFixed(text, value, 4);
  }
  text += '\n';
}

std::string trackingText(const TumSequence& sequence, const LogOptions& options) {
  pcrb::Random random = makeStream(options.seed, sequence.name + " tracking");
  const PoseError pose_error(options.seed, options.ground_truth_error);
  const double clock = static_cast<double>(sequence.clock_ns) * 1e-9;
  std::string text = "# ground truth trajectory\n# file: '" + sequence.name +
                     ".bag'\n# timestamp tx ty tz qx qy qz qw\n";
  bool negative = false;
  for (int i = 0; i < (duration(options) + 0.5) * kTrackingRate; ++i) {
    const double time = i / kTrackingRate + random.uniform(0.0, 2e-4);
    if (random.uniform() < 0.01) negative = !negative;  // q and −q are the same rotation
    const bool dropped = random.uniform() < 0.01;
    if (dropped || (time > kLostFrom && time < kLostFrom + kLostFor)) continue;
    const pcrb::Transform pose = displaced(sequence.T_world_camera(time), pose_error.at(time));
    appendPose(text, clock + time, pose, negative);
    if (i == 31) appendPose(text, clock + time, pose, negative);  // one stamp comes twice
  }
  return text;
}

/// Renders the frames of a recording, a few at a time, and writes them in their order.
void makeBag(const TumSequence& sequence, const Scene& scene, const LogOptions& options,
             const std::string& output, const std::string& file) {
  const DepthCamera camera = makeKinect(options.size.tum_image_divisor);
  const int count = frameCount(sequence, options);
  const std::filesystem::path path = std::filesystem::path(output) / file;
  std::filesystem::create_directories(path.parent_path());
  TumBag bag(path.string(), camera);
  for (int first = 0; first < count; first += options.threads) {
    std::vector<RgbdFrame> frames(
        static_cast<std::size_t>(std::min(options.threads, count - first)));
    pcrb::parallelFor(frames.size(), options.threads, [&](std::size_t i) {
      const int number = first + static_cast<int>(i);
      const double time = static_cast<double>(frameStamp(sequence, number, options)) * 1e-9;
      pcrb::Random random =
          makeStream(options.seed, sequence.name, static_cast<std::uint64_t>(number));
      frames[i] = takeFrame(scene, camera, sequence.T_world_camera(time), time, random);
    });
    for (std::size_t i = 0; i < frames.size(); ++i) {
      const int number = first + static_cast<int>(i);
      const std::int64_t stamp = sequence.clock_ns + frameStamp(sequence, number, options);
      if (sequence.clouds) {
        bag.writeClouds(frames[i], stamp, number);
      } else {
        bag.writeImages(frames[i], stamp, number);
      }
    }
  }
  bag.commit();
}

std::string bagFile(const TumSequence& sequence) {
  return "tum/" + sequence.name + (sequence.clouds ? "-2hz-with-pointclouds.bag" : ".bag");
}

/// `1311877977.413521548.pcd`.
std::string cloudName(pcrb::Stamp stamp) { return pcrb::formatStamp(stamp) + ".pcd"; }

}  // namespace

LogPlan planTumLogs(const LogOptions& options) {
  LogPlan plan;
  const LazyScene scene = lazyScene(describeOffice, options.seed);
  const PoseError pose_error(options.seed, options.ground_truth_error);
  LogJob bags;  // one job: rosbag's plugin loader cannot open two bags at once from two threads
  for (const TumSequence& sequence : tumPlans()) {
    bags.files.push_back(bagFile(sequence));
    const std::string tracking = "tum/" + sequence.name + "-groundtruth.txt";
    plan.jobs.push_back({{tracking}, [=](const std::string& output) {
                           writeLogFile(output, tracking, trackingText(sequence, options));
                         }});
    for (int i = 0; i < frameCount(sequence, options); ++i) {
      const std::int64_t stamp = frameStamp(sequence, i, options);
      plan.errors.push_back({"tum", sequence.published, cloudName(sequence.clock_ns + stamp),
                             pose_error.at(static_cast<double>(stamp) * 1e-9)});
    }
  }
  bags.make = [=](const std::string& output) {
    for (const TumSequence& sequence : tumPlans()) {
      makeBag(sequence, scene.get(), options, output, bagFile(sequence));
    }
  };
  plan.jobs.insert(plan.jobs.begin(), bags);
  return plan;
}

}  // namespace pcrb_tools::simulation
