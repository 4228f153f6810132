#pragma once

namespace pcrb {

/// Names of the ROS interface (DESIGN §5), relative to the server's namespace.
namespace topics {

constexpr const char* kTarget = "target";
constexpr const char* kSource = "source";
constexpr const char* kProblem = "problem";
constexpr const char* kInitialPose = "initialpose";
constexpr const char* kResult = "result";
constexpr const char* kSummary = "summary";
constexpr const char* kSourceAligned = "source_aligned";
constexpr const char* kMarkers = "markers";
constexpr const char* kDebugTruth = "debug/truth";                ///< only with ~debug
constexpr const char* kDebugPerturbation = "debug/perturbation";  ///< only with ~debug

}  // namespace topics

namespace services {

constexpr const char* kReady = "ready";
constexpr const char* kSubmitPose = "submit_pose";
constexpr const char* kStart = "start";  ///< private, as are the next two
constexpr const char* kPause = "pause";
constexpr const char* kSkip = "skip";

}  // namespace services

/// Namespace of a node that was started without one.
constexpr const char* kDefaultNamespace = "pcrb";

}  // namespace pcrb
