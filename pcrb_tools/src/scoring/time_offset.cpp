#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "pcrb_core/error.hpp"
#include "pcrb_core/io/number.hpp"
#include "scoring/tracked_poses.hpp"

namespace pcrb_tools {
namespace {

constexpr std::size_t kLeastMotions = 3;

pcrb::Stamp inNanoseconds(double seconds) {
  return static_cast<pcrb::Stamp>(std::llround(seconds * static_cast<double>(pcrb::kSecond)));
}

/// How badly motions fit with an offset.
class OffsetCost {
 public:
  OffsetCost(const std::vector<pcrb::StampedPose>& truth, const pcrb::Trajectory& estimate,
             const pcrb::Transform& T_body_sensor)
      : truth_(truth), estimate_(estimate), T_body_sensor_(T_body_sensor) {}

  /// Mean square of the relative errors, m^2; nothing where too few motions can be compared.
  std::optional<double> at(double offset) const {
    double sum = 0.0;
    std::size_t count = 0;
    std::optional<pcrb::Transform> last;
    for (std::size_t i = 0; i != truth_.size(); ++i) {
      const auto pose = estimateAt(truth_[i].stamp - inNanoseconds(offset));
      if (pose && last) {
        const pcrb::Transform true_motion =
            truth_[i - 1].T_world_body.inverse() * truth_[i].T_world_body;
        sum += (true_motion.inverse() * (last->inverse() * *pose)).translation().squaredNorm();
        ++count;
      }
      last = pose;
    }
    const bool is_enough = count >= kLeastMotions && 2 * count + 2 >= truth_.size();
    return is_enough ? std::optional(sum / static_cast<double>(count)) : std::nullopt;
  }

 private:
  std::optional<pcrb::Transform> estimateAt(pcrb::Stamp stamp) const {
    const auto pose = estimate_.interpolate(stamp, pcrb::kSecond);
    if (pose.status != pcrb::PoseStatus::kFound) return std::nullopt;
    return pose.T_world_body * T_body_sensor_;
  }

  const std::vector<pcrb::StampedPose>& truth_;
  const pcrb::Trajectory& estimate_;
  const pcrb::Transform T_body_sensor_;
};

/// Half the usual time between poses, but not so little that the search takes minutes.
double stepOf(const pcrb::Trajectory& estimate, double largest) {
  constexpr double kMostSteps = 2000.0;
  const double span = static_cast<double>(estimate.lastStamp() - estimate.firstStamp()) * 1e-9;
  const double interval = span / static_cast<double>(std::max<std::size_t>(estimate.size() - 1, 1));
  return std::max(interval / 2.0, 2.0 * largest / kMostSteps);
}

/// The least cost between two offsets around a minimum.
double refine(const OffsetCost& cost, double low, double high) {
  constexpr double kGolden = 0.6180339887498949;
  constexpr double kPrecision = 1e-6;  // s
  const auto at = [&cost](double offset) {
    return cost.at(offset).value_or(std::numeric_limits<double>::infinity());
  };
  while (high - low > kPrecision) {
    const double left = high - kGolden * (high - low);
    const double right = low + kGolden * (high - low);
    const bool is_left = at(left) < at(right);
    (is_left ? high : low) = is_left ? right : left;
  }
  return (low + high) / 2.0;
}

}  // namespace

double estimateTimeOffset(const std::vector<pcrb::StampedPose>& truth,
                          const pcrb::Trajectory& estimate, const pcrb::Transform& T_body_sensor,
                          double largest) {
  constexpr double kFlat = 1e-10;  // m^2
  const OffsetCost cost(truth, estimate, T_body_sensor);
  const double step = stepOf(estimate, largest);
  double best = 0.0;
  double least = std::numeric_limits<double>::infinity();
  double most = 0.0;
  for (double offset = -largest; offset <= largest; offset += step) {
    const auto found = cost.at(offset);
    if (!found) continue;
    most = std::max(most, *found);
    if (*found < least) {
      least = *found;
      best = offset;
    }
  }
  if (!(most - least > kFlat)) {
    throw pcrb::InvalidParameter(
        "found no time offset within " + pcrb::formatShortest(largest) +
        " s that fits better than others, expected motions that change in time, and poses of half "
        "of the scans at least");
  }
  return refine(cost, std::max(-largest, best - step), std::min(largest, best + step));
}

pcrb::Trajectory shifted(const pcrb::Trajectory& trajectory, double seconds) {
  std::vector<pcrb::StampedPose> poses;
  for (const pcrb::Stamp stamp : trajectory.stamps()) {
    poses.push_back({stamp + inNanoseconds(seconds), trajectory.nearest(stamp).T_world_body});
  }
  return pcrb::Trajectory(std::move(poses));
}

}  // namespace pcrb_tools
