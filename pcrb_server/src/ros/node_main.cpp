#include "pcrb_server/node_main.hpp"

#include <pthread.h>
#include <ros/master.h>
#include <ros/ros.h>
#include <signal.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <atomic>
#include <cstdlib>
#include <iostream>
#include <thread>
#include <vector>

#include "pcrb_core/error.hpp"
#include "pcrb_core/io/process_limits.hpp"
#include "pcrb_core/io/text.hpp"
#include "pcrb_server/topics.hpp"
#include "ros/node_calls.hpp"

namespace pcrb {

void ShutdownRequest::onShutdown(std::function<void()> callback) {
  const std::lock_guard<std::mutex> lock(mutex_);
  callback_ = std::move(callback);
  if (requested_) callback_();
}

void ShutdownRequest::forget() {
  const std::lock_guard<std::mutex> lock(mutex_);
  callback_ = nullptr;
}

bool ShutdownRequest::requested() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return requested_;
}

void ShutdownRequest::make() {
  const std::lock_guard<std::mutex> lock(mutex_);
  requested_ = true;
  if (callback_) callback_();
}

/// Waits for the signals in a thread of its own, where any function may be called.
class ShutdownWatcher {
 public:
  explicit ShutdownWatcher(ShutdownRequest& request)
      : thread_([this, &request] { watch(request); }) {}
  ~ShutdownWatcher() {
    is_over_ = true;
    thread_.join();
  }
  ShutdownWatcher(const ShutdownWatcher&) = delete;
  ShutdownWatcher& operator=(const ShutdownWatcher&) = delete;

  static sigset_t signals() {
    sigset_t set;
    sigemptyset(&set);
    sigaddset(&set, SIGINT);
    sigaddset(&set, SIGTERM);
    return set;
  }

 private:
  void watch(ShutdownRequest& request) {
    const sigset_t set = signals();
    const timespec period{0, 50'000'000};
    while (!is_over_) {
      const int signal = sigtimedwait(&set, nullptr, &period);
      if (signal > 0 && request.requested()) _exit(128 + signal);
      if (signal > 0 || (ros::isShuttingDown() && !request.requested())) request.make();
    }
  }

  std::atomic<bool> is_over_{false};
  std::thread thread_;
};

namespace {

constexpr double kClockLimit = 5.0;   // s to wait for /clock
constexpr double kMasterLimit = 0.5;  // s to wait for the master at the start
constexpr double kNodeLimit = 10.0;   // s to wait for a node that may run under our name

/// The master would shut down a node that runs under our name.
void requireFreeName(const std::string& name) {
  const auto address = addressOf(name);
  const auto pid = address ? queryPid(*address, kNodeLimit) : std::nullopt;
  if (!pid) return;
  throw Error("already runs as " + name + " (pid " + std::to_string(*pid) + " on " + address->host +
              "): end that one, or start this one under another name or namespace");
}

void connect() {
  if (!ros::master::check()) {
    throw Error("no ROS master at " + ros::master::getURI() +
                ": start roscore or roslaunch, or set "
                "ROS_MASTER_URI");
  }
  requireFreeName(ros::this_node::getName());
  ros::start();
  if (!ros::Time::waitForValid(ros::WallDuration(kClockLimit))) {
    throw Error("use_sim_time is set, but nothing was published on /clock within 5 s");
  }
}

std::string footerOf(const NodeHelp& help) {
  if (help.parameters.empty()) return help.details;
  return "Private parameters (default):\n" + formatParameters(help.parameters) + "\n" +
         help.details;
}

}  // namespace

int runNode(int argc, char** argv, const NodeHelp& help,
            const std::function<int(ShutdownRequest&)>& body) {
  turnLimitsIntoErrors(help.name);
  setenv("ROS_NAMESPACE", kDefaultNamespace, 0);
  std::vector<std::string> arguments;
  ros::removeROSArgs(argc, argv, arguments);
  CLI::App app(help.description, help.name);
  app.footer(footerOf(help));
  try {
    // What a command line sets goes to the ROS master, as XML.
    for (int i = 1; i < argc; ++i) requireUtf8(argv[i], "a ROS master takes no other bytes");
    arguments.erase(arguments.begin());
    std::reverse(arguments.begin(), arguments.end());
    app.parse(arguments);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  } catch (const InvalidParameter& error) {
    std::cerr << help.name << ": " << error.what() << std::endl;
    return 2;
  }
  const sigset_t signals = ShutdownWatcher::signals();
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  // ros::init sets the parameters of the command line, and without a master would try for ever.
  ros::master::setRetryTimeout(ros::WallDuration(kMasterLimit));
  ros::init(argc, argv, help.name, ros::init_options::NoSigintHandler);
  ros::master::setRetryTimeout(ros::WallDuration(0.0));
  ShutdownRequest request;
  int status = 1;
  try {
    const ShutdownWatcher watcher(request);
    connect();
    status = body(request);
    request.forget();
  } catch (const std::exception& error) {
    request.forget();
    std::cerr << help.name << ": " << describeFailure(error) << std::endl;
  }
  ros::shutdown();
  return status;
}

}  // namespace pcrb
