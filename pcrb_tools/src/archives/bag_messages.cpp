#include "archives/bag_messages.hpp"

#include <ros/exception.h>
#include <rosbag/view.h>

#include <algorithm>
#include <filesystem>

#include "common/process.hpp"
#include "pcrb_core/io/derived_file.hpp"

namespace pcrb_tools {

bool isBag(const std::string& path) { return std::filesystem::path(path).extension() == ".bag"; }

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
    try {
      bags_.back()->open(path, rosbag::bagmode::Read);
    } catch (const rosbag::BagUnindexedException&) {
      throw pcrb::InvalidFile(path, 0, "a bag that was not closed",
                              "an index (rosbag reindex makes it)");
    } catch (const ros::Exception& error) {
      throw pcrb::InvalidFile(path, "damaged or no bag: " + std::string(error.what()));
    }
  }
}

std::size_t BagMessages::count(const std::vector<std::string>& topics) const {
  rosbag::View view;
  for (const auto& bag : bags_) view.addQuery(*bag, rosbag::TopicQuery(topics));
  return view.size();
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
