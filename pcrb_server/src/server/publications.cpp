#include "server/publications.hpp"

#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <pcrb_msgs/Problem.h>
#include <pcrb_msgs/Result.h>
#include <pcrb_msgs/Summary.h>
#include <visualization_msgs/MarkerArray.h>

#include <cmath>

#include "pcrb_core/run/scoring.hpp"
#include "pcrb_server/message_conversion.hpp"
#include "pcrb_server/topics.hpp"
#include "ros/drawing.hpp"
#include "ros/problem_messages.hpp"

namespace pcrb {

namespace {

constexpr std::uint32_t kResultQueue = 10000;

template <typename Message>
Message withHeader(const std::string& frame, const ros::Time& stamp) {
  Message message;
  message.header = makeHeader(frame, stamp);
  return message;
}

}  // namespace

Publications::Publications(ros::NodeHandle& node, const ServerParameters& parameters)
    : parameters_(parameters) {
  target_ = node.advertise<sensor_msgs::PointCloud2>(topics::kTarget, 1, true);
  source_ = node.advertise<sensor_msgs::PointCloud2>(topics::kSource, 1, true);
  problem_ = node.advertise<pcrb_msgs::Problem>(topics::kProblem, 1, listeners_.joined(),
                                                listeners_.left(), ros::VoidPtr(), true);
  initial_pose_ = node.advertise<geometry_msgs::PoseWithCovarianceStamped>(topics::kInitialPose, 1);
  result_ = node.advertise<pcrb_msgs::Result>(topics::kResult, kResultQueue);
  summary_ = node.advertise<pcrb_msgs::Summary>(topics::kSummary, 1, summary_readers_.joined(),
                                                summary_readers_.left(), ros::VoidPtr(), true);
  source_aligned_ = node.advertise<sensor_msgs::PointCloud2>(topics::kSourceAligned, 1);
  markers_ = node.advertise<visualization_msgs::MarkerArray>(topics::kMarkers, 1);
  if (!parameters.configuration.debug) return;
  truth_ = node.advertise<geometry_msgs::PoseStamped>(topics::kDebugTruth, 10);
  perturbation_ = node.advertise<geometry_msgs::PoseStamped>(topics::kDebugPerturbation, 10);
}

void Publications::publishTarget(const PreparedProblem& prepared,
                                 const Announcement& announcement) {
  const Eigen::Vector3d& origin = prepared.target->cloud.local_origin;
  // Where an audited target is on the earth is secret.
  is_earth_known_ |= !origin.isZero() && !parameters_.configuration.presentation.audit;
  if (is_earth_known_) {
    broadcast("earth", parameters_.frames.map, Transform(Eigen::Translation3d(origin)),
              announcement.stamp, true);
  }
  broadcast(parameters_.frames.map, "pcrb_target",
            Transform(Eigen::Translation3d(prepared.presentation.target_applied *
                                           boxCenter(prepared.target->cloud))),
            announcement.stamp, true);
  target_stamp_ = announcement.stamp;
  SerializedCloud target = prepared.target_message;
  target.setStamp(announcement.stamp);
  target_.publish(target);
}

void Publications::publishProblem(const PreparedProblem& prepared,
                                  const Announcement& announcement) {
  if (prepared.publishes_target) publishTarget(prepared, announcement);
  problem_.publish(problemMessage(prepared, announcement, target_stamp_, parameters_.configuration,
                                  parameters_.frames));
}

void Publications::publishSource(const PreparedProblem& prepared,
                                 const Announcement& announcement) {
  if (hasGuess(prepared, parameters_.configuration)) {
    initial_pose_.publish(initialPoseMessage(prepared, announcement.stamp, parameters_.frames));
  }
  SerializedCloud source = prepared.source_message;
  source.setStamp(announcement.stamp);
  source_.publish(source);
  if (parameters_.configuration.debug) showTruth(prepared, announcement);
}

void Publications::showTruth(const PreparedProblem& prepared, const Announcement& announcement) {
  auto pose = withHeader<geometry_msgs::PoseStamped>(parameters_.frames.map, announcement.stamp);
  pose.pose = toMessage(prepared.presentation.ideal());
  truth_.publish(pose);
  pose.pose = toMessage(prepared.P);
  perturbation_.publish(pose);
}

void Publications::publishResult(const PreparedProblem& prepared, const Announcement& announcement,
                                 const Result& result) {
  auto message = withHeader<pcrb_msgs::Result>(parameters_.frames.map, announcement.stamp);
  message.problem_id = announcement.problem_id;
  message.data_set = result.key.data_set;
  message.kind = kindNumber(result.key.kind);
  message.index = announcement.index;
  message.count = announcement.count;
  message.outcome = static_cast<std::uint8_t>(result.outcome);
  message.error = result.error;
  message.initial_misalignment = result.initial_misalignment;
  message.rotation_error = result.rotation_error;
  message.translation_error = result.translation_error;
  message.runtime = result.runtime.value_or(std::nan(""));
  message.reason = result.reason;
  publishOrWithhold(message);
  showReply(prepared, announcement, result);
}

void Publications::publishOrWithhold(pcrb_msgs::Result message) {
  if (!areErrorsPublic()) {
    withheld_.push_back(message);
    message.error = message.initial_misalignment = std::nan("");
    message.rotation_error = message.translation_error = std::nan("");
  }
  result_.publish(message);
}

void Publications::publishErrors() {
  for (const pcrb_msgs::Result& message : withheld_) result_.publish(message);
  withheld_.clear();
}

void Publications::showReply(const PreparedProblem& prepared, const Announcement& announcement,
                             const Result& result) {
  const std_msgs::Header in_map = makeHeader(parameters_.frames.map, announcement.stamp);
  const Transform reply = scoredPose(prepared, result);
  broadcast(parameters_.frames.map, "pcrb_reply", reply, announcement.stamp, false);
  const Transform T_map_source = reply * prepared.presentation.applied;
  if (source_aligned_.getNumSubscribers() > 0) {
    source_aligned_.publish(toMessage(*prepared.published_source, T_map_source, in_map));
  }
  if (areErrorsPublic() && markers_.getNumSubscribers() > 0) {
    visualization_msgs::MarkerArray markers;
    markers.markers.push_back(
        textMarker(in_map, T_map_source * prepared.source->metric->centroid(), errorText(result)));
    markers_.publish(markers);
  }
}

void Publications::broadcast(const std::string& parent, const std::string& child,
                             const Transform& T, const ros::Time& stamp, bool is_static) {
  if (!parameters_.publish_tf) return;
  const auto transform = toMessage(T, makeHeader(parent, stamp), child);
  if (is_static) {
    static_tf_.sendTransform(transform);
  } else {
    tf_.sendTransform(transform);
  }
}

int Publications::summaryDepartures() const {
  int count = 0;
  for (const auto& [node, departures] : summary_readers_.departures()) count += departures;
  return count;
}

void Publications::publishSummary(const std::vector<SequenceSummary>& summaries, bool finished) {
  auto message = withHeader<pcrb_msgs::Summary>("", ros::Time::now());
  message.finished = finished ? 1 : 0;
  const auto shown = [&](double error) {
    return finished || areErrorsPublic() ? error : std::nan("");
  };
  for (const auto& summary : summaries) {
    pcrb_msgs::SequenceSummary row;
    row.name = summary.name;
    row.kind = summary.kind;
    row.count = static_cast<std::uint32_t>(summary.error.count);
    row.replied = static_cast<std::uint32_t>(summary.outcomes[0]);
    row.failed = static_cast<std::uint32_t>(summary.outcomes[1]);
    row.timed_out = static_cast<std::uint32_t>(summary.outcomes[2]);
    row.rejected = static_cast<std::uint32_t>(summary.outcomes[3]);
    row.skipped = static_cast<std::uint32_t>(summary.outcomes[4]);
    row.median = shown(summary.error.median);
    row.q75 = shown(summary.error.q75);
    row.q95 = shown(summary.error.q95);
    row.mean = shown(summary.error.mean);
    row.stddev = shown(summary.error.stddev);
    message.sequences.push_back(row);
  }
  summary_.publish(message);
}

}  // namespace pcrb
