#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <optional>
#include <string>

#include "server/problem_session.hpp"

namespace pcrb {
namespace session_test {

using Request = pcrb_msgs::SubmitPose::Request;
using Response = pcrb_msgs::SubmitPose::Response;
using Wait = ProblemSession::Wait;

constexpr std::chrono::duration<double> kLong(60.0);
constexpr std::chrono::duration<double> kOver(0.0);  ///< a limit that has passed
inline const ros::Time kStamp(1000, 5);

inline Request validReply(const std::string& id = "a") {
  Request request;
  request.problem_id = id;
  request.pose.header.frame_id = "map";
  request.pose.pose.position.x = 1.5;
  request.pose.pose.orientation.w = 1.0;
  request.solver_time = std::nan("");
  return request;
}

inline std::optional<Transform> noTransform(const std::string&, const ros::Time&) {
  return std::nullopt;
}

/// Announces a problem, has /node call ready, and starts its clock.
inline void begin(ProblemSession& session, const std::string& id,
                  std::chrono::duration<double> limit) {
  session.announce(id, kStamp);
  pcrb_msgs::Ready::Request request;
  pcrb_msgs::Ready::Response response;
  request.problem_id = id;
  session.ready("/node", request, response);
  session.startClock(limit);
}

class ProblemSessionTest : public testing::Test {
 protected:
  int submit(const Request& request, const std::string& caller = "/node") {
    Response response;
    session_.submit(caller, request, response);
    EXPECT_EQ(response.accepted != 0, response.code == Response::OK);
    EXPECT_EQ(response.message.empty(), response.code == Response::OK) << response.message;
    return response.code;
  }

  bool ready(const std::string& id, const std::string& caller = "/node") {
    pcrb_msgs::Ready::Request request;
    pcrb_msgs::Ready::Response response;
    request.problem_id = id;
    session_.ready(caller, request, response);
    EXPECT_EQ(response.message.empty(), response.accepted != 0);
    EXPECT_LT(response.message.size(), 300u);
    return response.accepted != 0;
  }

  void startProblem(const std::string& id, std::chrono::duration<double> limit = kLong) {
    begin(session_, id, limit);
  }

  ProblemSession session_{"map", noTransform};
  Reply reply_;
};

}  // namespace session_test
}  // namespace pcrb
