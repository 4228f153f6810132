#include "archives/bag_messages.hpp"

#include <ros/exception.h>
#include <rosbag/view.h>

#include <algorithm>
#include <filesystem>
#include <stdexcept>

#include "archives/bag_structure.hpp"
#include "common/process.hpp"
#include "pcrb_core/io/derived_file.hpp"

namespace pcrb_tools {

bool isBag(const std::string& path) {
  const std::string ending = std::filesystem::path(path).extension().string();
  return ending == ".bag" || ending == ".active" || ending == ".db3" || ending == ".mcap";
}

bool areBags(const std::vector<std::string>& inputs) {
  const auto bags = std::count_if(inputs.begin(), inputs.end(), isBag);
  if (bags == 0 || static_cast<std::size_t>(bags) == inputs.size()) return bags > 0;
  throw pcrb::InvalidParameter("found bags together with other inputs, expected bags only or none");
}

BagMessages::BagMessages(const std::vector<std::string>& paths) {
  for (const auto& path : paths) {
    identity_ += pcrb::fileIdentity(path) + ' ';
    paths_ += (paths_.empty() ? "" : " + ") + path;
    bags_.push_back(std::make_unique<rosbag::Bag>());
    requireReadableBag(path);
    try {
      bags_.back()->open(path, rosbag::bagmode::Read);
    } catch (const std::runtime_error& error) {  // rosbag's, or of a stamp that is none
      throw pcrb::InvalidFile(path, "damaged or no bag: " + std::string(error.what()));
    }
  }
}

std::size_t BagMessages::count(const std::vector<std::string>& topics) const {
  rosbag::View view;
  for (const auto& bag : bags_) view.addQuery(*bag, rosbag::TopicQuery(topics));
  return view.size();
}

std::map<std::string, std::string> BagMessages::topics() const {
  std::map<std::string, std::string> types;
  for (const auto& bag : bags_) {
    for (const auto* connection : rosbag::View(*bag).getConnections()) {
      types[connection->topic] = connection->datatype;
    }
  }
  return types;
}

std::string BagMessages::describeTopics() const {
  const auto types = topics();
  std::string text = types.empty() ? "no topic at all" : "the topics";
  for (const auto& [topic, type] : types) text += " " + topic + " (" + type + ")";
  return text;
}

void BagMessages::forEach(const std::vector<std::string>& topics,
                          const std::function<void(const rosbag::MessageInstance&)>& take) const {
  try {
    rosbag::View view;
    for (const auto& bag : bags_) view.addQuery(*bag, rosbag::TopicQuery(topics));
    for (const auto& message : view) {
      Interruption::check();
      take(message);
    }
  } catch (const ros::Exception& error) {
    throw pcrb::InvalidFile(paths_, "damaged: " + std::string(error.what()));
  }
}

}  // namespace pcrb_tools
