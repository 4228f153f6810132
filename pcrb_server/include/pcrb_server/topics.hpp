#pragma once

namespace pcrb {

/// Names of the ROS interface (docs/interface.md), relative to the server's namespace.
namespace topics {

constexpr const char* kTarget = "target";
constexpr const char* kSource = "source";
constexpr const char* kProblem = "problem";
constexpr const char* kInitialPose = "initialpose";
constexpr const char* kResult = "result";
constexpr const char* kSummary = "summary";
constexpr const char* kSourceAligned = "source_aligned";
constexpr const char* kMarkers = "markers";
constexpr const char* kMap = "map";                 ///< of replay: the map, given or growing
constexpr const char* kScan = "scan";               ///< of replay
constexpr const char* kSensor = "sensor";           ///< of replay: true pose of the scan's sensor
constexpr const char* kPath = "path";               ///< of replay: the same of all scans so far
constexpr const char* kSourceTrue = "source_true";  ///< of replay: the source at ground truth
constexpr const char* kCaption = "caption";         ///< of replay: rows `name: value`
constexpr const char* kTf = "/tf";
constexpr const char* kTfStatic = "/tf_static";
constexpr const char* kDebugTruth = "debug/truth";                ///< only with ~debug
constexpr const char* kDebugPerturbation = "debug/perturbation";  ///< only with ~debug

}  // namespace topics

namespace services {

constexpr const char* kReady = "ready";
constexpr const char* kSubmitPose = "submit_pose";
constexpr const char* kStart = "start";  ///< private, as are the next two
constexpr const char* kPause = "pause";
constexpr const char* kSkip = "skip";
constexpr const char* kStep = "step";  ///< of replay, as is the next one
constexpr const char* kBack = "back";

}  // namespace services

/// Namespace of a node that was started without one.
constexpr const char* kDefaultNamespace = "pcrb";

}  // namespace pcrb
