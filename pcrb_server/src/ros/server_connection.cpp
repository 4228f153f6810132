#include "pcrb_server/server_connection.hpp"

#include <pcrb_msgs/Ready.h>
#include <ros/console.h>

#include "pcrb_server/topics.hpp"

namespace pcrb {

namespace {

/// Calls a service over a connection that is kept, and made anew after the server was restarted.
template <typename Service>
bool call(ros::NodeHandle& node, const char* name, ros::ServiceClient& client, Service& service) {
  if (client.isValid() && client.call(service)) return true;
  client = node.serviceClient<Service>(name, true);
  return client.call(service);
}

}  // namespace

ServerConnection::ServerConnection(std::function<void()> changed) : changed_(std::move(changed)) {
  problem_subscriber_ = subscribe(topics::kProblem, problem_);
  target_subscriber_ = subscribe(topics::kTarget, target_);
  source_subscriber_ = subscribe(topics::kSource, source_);
  summary_subscriber_ = node_.subscribe<pcrb_msgs::Summary>(
      topics::kSummary, 1,
      [this](const pcrb_msgs::SummaryConstPtr& message) { is_finished_ = message->finished != 0; });
}

template <typename Message>
ros::Subscriber ServerConnection::subscribe(const char* topic,
                                            boost::shared_ptr<Message const>& newest) {
  return node_.subscribe<Message>(
      topic, 1,
      [this, &newest](const boost::shared_ptr<Message const>& message) {
        newest = message;
        if (changed_) changed_();
      },
      ros::VoidConstPtr(), ros::TransportHints().tcpNoDelay());
}

sensor_msgs::PointCloud2ConstPtr ServerConnection::target() const {
  const bool is_there = problem_ && target_ && target_->header.stamp == problem_->target_stamp;
  return is_there ? target_ : nullptr;
}

sensor_msgs::PointCloud2ConstPtr ServerConnection::source() const {
  const bool is_there = problem_ && source_ && source_->header.stamp == problem_->header.stamp;
  return is_there ? source_ : nullptr;
}

bool ServerConnection::callReady() {
  pcrb_msgs::Ready service;
  service.request.problem_id = problem_->problem_id;
  if (call(node_, services::kReady, ready_, service)) return true;
  ROS_WARN("the server does not answer on `%s`", ready_.getService().c_str());
  return false;
}

void ServerConnection::submit(const pcrb_msgs::SubmitPose::Request& request) {
  pcrb_msgs::SubmitPose service;
  service.request = request;
  if (!call(node_, services::kSubmitPose, submit_, service)) {
    ROS_WARN("the server does not answer on `%s`", submit_.getService().c_str());
  } else if (service.response.accepted == 0) {
    ROS_WARN("reply rejected: %s", service.response.message.c_str());
  }
}

}  // namespace pcrb
