#include "conversion/live_run.hpp"

#include <ros/callback_queue.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "conversion/live_node.hpp"
#include "pcrb_core/io/number.hpp"
#include "pcrb_core/parallel.hpp"

namespace pcrb_tools {

const char* const kLiveParametersHelp = R"(
  root              root of the common layout (required)
  sequence          folder of the sequence (required)
  data_set          folder of the data set
  threads           (number of processors)
  max_waiting (64)  clouds that may wait to be converted; what comes beyond is dropped and counted
  force (false)     replace clouds that no converter made
  idle_limit (0)    end when nothing has come for this long after the first message, s; 0 = never)";

bool takeLiveFlag(int& argc, char** argv) {
  char** const end = std::remove_if(argv, argv + argc, [](const char* argument) {
    return std::string_view(argument) == "--live";
  });
  const bool live = end != argv + argc;
  argc = static_cast<int>(end - argv);
  return live;
}

LiveOptions readLiveParameters(pcrb::NodeParameters& parameters, ConversionRequest& request) {
  constexpr int kMostThreads = 1024;
  request.root = parameters.requiredPath("root");
  request.sequence = parameters.requiredString("sequence");
  request.data_set = parameters.string("data_set", request.data_set);
  request.threads = parameters.integer("threads", pcrb::processorCount(), 1, kMostThreads);
  request.max_waiting = static_cast<std::size_t>(parameters.integer("max_waiting", 64, 1, 1 << 20));
  request.force = parameters.boolean("force", false);
  request.live = true;
  return {parameters.number("idle_limit", 0.0, 0.0, 1e6)};
}

std::vector<double> readNumbers(pcrb::NodeParameters& parameters, const std::string& name,
                                std::size_t count) {
  const auto words = parameters.words(name, "");
  std::vector<double> numbers;
  for (const auto& word : words) {
    const auto number = pcrb::parseDouble(word);
    if (number && std::isfinite(*number)) numbers.push_back(*number);
  }
  if (numbers.size() == words.size() && (words.empty() || words.size() == count)) return numbers;
  parameters.addMistake("~" + name + ": expected " + std::to_string(count) +
                        " numbers separated by blanks, as text");
  return {};
}

void LiveInput::run(const pcrb::ShutdownRequest& shutdown, const LiveOptions& options,
                    Conversion& conversion) {
  const ros::WallDuration period(0.1);
  while (!shutdown.requested() && !isIdle(options.idle_limit)) {
    ros::getGlobalCallbackQueue()->callAvailable(period);
    conversion.check();
  }
  ros::getGlobalCallbackQueue()->callAvailable();
  for (const auto& [topic, count] : counts_) {
    if (count == 0) conversion.note("nothing came on " + topic);
  }
  subscribers_.clear();
}

bool LiveInput::isIdle(double limit) {
  std::size_t total = 0;
  for (const auto& [topic, count] : counts_) total += count;
  const auto now = std::chrono::steady_clock::now();
  if (total != seen_) last_ = now;
  seen_ = total;
  return limit > 0.0 && total > 0 && std::chrono::duration<double>(now - last_).count() > limit;
}

}  // namespace pcrb_tools
