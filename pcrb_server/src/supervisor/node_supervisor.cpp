#include "supervisor/node_supervisor.hpp"

#include <pcrb_msgs/Result.h>
#include <ros/names.h>
#include <ros/package.h>
#include <ros/param.h>
#include <unistd.h>

#include <filesystem>
#include <thread>
#include <utility>

#include "pcrb_core/error.hpp"
#include "pcrb_server/node_parameters.hpp"
#include "pcrb_server/topics.hpp"
#include "ros/notices.hpp"

namespace pcrb {

namespace {

constexpr auto kPollPeriod = std::chrono::milliseconds(50);
constexpr auto kEarly = std::chrono::seconds(10);  // a death that soon after the start is early
constexpr int kMaxEarlyDeaths = 3;

/// name:=value of name=value: roslaunch takes an argument that has := in its value for none.
std::string launchArgument(std::string word) {
  const std::size_t equals = word.find('=');
  const bool is_plain = equals != std::string::npos && equals > 0 && word[equals - 1] != ':';
  return is_plain ? word.replace(equals, 1, ":=") : word;
}

/// A node that reads its map when it starts must not do so before the bridge has written it.
bool isStartedBy(const std::string& bridge) {
  if (bridge.empty()) return false;
  const std::string place = ros::names::resolve(bridge);
  std::string restart = "never";
  if (ros::param::get(place + "/bridge_parameters/restart", restart)) return restart != "never";
  for (const char* group : {"", "/recipe/bridge"}) {
    if (ros::param::get(place + group + "/restart", restart) && restart != "never") return true;
  }
  return false;
}

}  // namespace

const ParameterTable kSupervisorParameters{
    {"launch", kRequired, "", "launch file, or its package and its name, separated by a blank"},
    {"args", "", "",
     "arguments of the launch file, name=value, separated by blanks; quotes keep a value with "
     "blanks "
     "together; $NAME and ${NAME:-other} are "
     "variables of the environment"},
    {"autostart", "true", "", "start at once; false: only on request"},
    {"bridge", "", "",
     "name of a localization_bridge; one that starts the node anew (its restart, also that of its "
     "recipe or file) starts it the first time, too"}};

SupervisorParameters readSupervisorParameters() {
  NodeParameters reader(kSupervisorParameters);
  SupervisorParameters parameters;
  parameters.command = {"roslaunch", "--wait"};
  const std::string given = reader.string("launch");
  std::vector<std::string> launch{given};
  const bool is_path_with_blanks = std::filesystem::is_regular_file(given);
  if (!is_path_with_blanks) {
    reader.check([&] { launch = splitArguments("launch", given); });
  }
  if (launch.size() > 2) {
    reader.addMistake("~launch: expected a launch file, or a package and its launch file");
  }
  const std::string mistake =
      launch.size() == 1 ? relativePathMistake("node_launch", launch.front()) : "";
  if (!mistake.empty()) reader.addMistake("~launch: " + mistake + ", or a package and its file");
  parameters.command.insert(parameters.command.end(), launch.begin(), launch.end());
  std::vector<std::string> arguments;
  const std::string text = reader.string("args");
  reader.check([&] { arguments = splitArguments("args", text); });
  for (const auto& word : arguments) {
    reader.check(
        [&] { parameters.command.push_back(expandVariables("~args", launchArgument(word))); });
    if (word.find('=') == std::string::npos) {
      reader.addMistake("~args: found `" + word + "`, expected name=value");
    }
  }
  const bool is_wanted_at_once = reader.boolean("autostart");
  parameters.autostart = !isStartedBy(reader.string("bridge")) && is_wanted_at_once;
  reader.allowOwnParameter("provenance");
  reader.allowOwnParameter("launch_mistakes");
  reader.finish();
  return parameters;
}

void describeLaunch(const SupervisorParameters& parameters, const ShutdownRequest& shutdown) {
  const std::string note = ros::names::resolve("~provenance");
  ros::param::del(note);
  ros::param::del(ros::names::resolve("~launch_mistakes"));
  const std::string script = ros::package::getPath("pcrb_server") + "/scripts/describe_launch.py";
  std::vector<std::string> command{PCRB_PYTHON, "-B", script, note};
  command.insert(command.end(), parameters.command.begin() + 2, parameters.command.end());
  SupervisedCommand description(command);
  description.start();
  while (!shutdown.requested() && description.isRunning()) std::this_thread::sleep_for(kPollPeriod);
  if (shutdown.requested() || ros::param::has(note)) return;
  std::vector<std::string> mistakes;
  ros::param::get(ros::names::resolve("~launch_mistakes"), mistakes);
  std::string message = "the node's launch file cannot be started as asked";
  if (mistakes.empty()) message += ": the lines above say why";
  for (const auto& mistake : mistakes) message += "\n  " + mistake;
  throw Error(message);
}

NodeSupervisor::NodeSupervisor(const SupervisorParameters& parameters, ShutdownRequest& shutdown)
    : command_(parameters.command),
      shutdown_(shutdown),
      parent_(getppid()),
      is_wanted_(parameters.autostart) {
  service_ = offerTrigger(node_, "restart", [this] { return restart(); });
  results_ = ros::NodeHandle().subscribe<pcrb_msgs::Result>(
      topics::kResult, 1, [this](const pcrb_msgs::ResultConstPtr&) {
        const std::lock_guard<std::mutex> lock(mutex_);
        has_result_ = true;
      });
  shutdown_.onShutdown([this] {
    const std::lock_guard<std::mutex> lock(mutex_);
    is_over_ = true;
    changed_.notify_all();
  });
  spinner_.start();
}

/// A request that waits for run() would keep the spinner's thread for ever.
NodeSupervisor::~NodeSupervisor() {
  shutdown_.forget();
  const std::lock_guard<std::mutex> lock(mutex_);
  is_over_ = true;
  changed_.notify_all();
}

/// In the service's thread: hands the request to run() and waits until it has been met.
TriggerAnswer NodeSupervisor::restart() {
  std::unique_lock<std::mutex> lock(mutex_);
  is_requested_ = true;
  changed_.notify_all();
  changed_.wait(lock, [this] { return !is_requested_ || is_over_; });
  if (is_over_) return {false, "the supervisor ends"};
  return {true, "started anew"};
}

void NodeSupervisor::start() {
  started_ = std::chrono::steady_clock::now();
  command_.start();
}

void NodeSupervisor::answerRequest() {
  command_.stop();
  start();
  is_wanted_ = true;
  early_deaths_ = 0;
  const std::lock_guard<std::mutex> lock(mutex_);
  is_requested_ = false;
  changed_.notify_all();
}

bool NodeSupervisor::takeResult() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return std::exchange(has_result_, false);
}

void NodeSupervisor::keepAlive() {
  if (!is_wanted_ || command_.isRunning()) return;
  const bool is_first = started_ == std::chrono::steady_clock::time_point();
  const bool is_early = std::chrono::steady_clock::now() - started_ < kEarly;
  const bool was_there = takeResult();
  early_deaths_ = is_early && !is_first && !was_there ? early_deaths_ + 1 : 0;
  if (early_deaths_ >= kMaxEarlyDeaths) {
    throw Error("the node under test ended " + std::to_string(early_deaths_) +
                " times as soon as it was started: see what it printed");
  }
  if (!is_first) tellPeople("the node under test has ended: it is started anew");
  command_.stop();  // what it left behind
  start();
}

void NodeSupervisor::run() {
  const auto is_due = [this] { return is_requested_ || is_over_; };
  while (true) {
    bool is_requested = false;
    {
      std::unique_lock<std::mutex> lock(mutex_);
      changed_.wait_for(lock, kPollPeriod, is_due);
      if (is_over_) break;
      is_requested = is_requested_;
    }
    if (getppid() != parent_) {
      tellPeople("the process that started node_supervisor has ended, and so does this");
      break;
    }
    if (is_requested) {
      answerRequest();
    } else {
      keepAlive();
    }
  }
  command_.stop();
}

}  // namespace pcrb
