#pragma once

#include <rosbag/bag.h>
#include <rosbag/message_instance.h>

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "pcrb_core/error.hpp"

namespace pcrb_tools {

/// Whether a path has a bag's ending: also one of bags that cannot be read, to be named as such.
bool isBag(const std::string& path);

/// Whether the inputs of a converter are bags: all of them or none.
/// @throws InvalidParameter  for bags together with other inputs.
bool areBags(const std::vector<std::string>& inputs);

/// The messages of some topics of bags, in the order in which they were recorded.
class BagMessages {
 public:
  /// @throws InvalidFile  if a bag cannot be opened; a bag that was not closed is named as such.
  explicit BagMessages(const std::vector<std::string>& paths);

  std::size_t count(const std::vector<std::string>& topics) const;

  /// Calls back for each message.
  /// @throws InvalidFile  if a bag is damaged.
  void forEach(const std::vector<std::string>& topics,
               const std::function<void(const rosbag::MessageInstance&)>& take) const;

  /// Types by topic.
  std::map<std::string, std::string> topics() const;

  /// For messages of errors: the topics with their types, or what else there is.
  std::string describeTopics() const;

  /// Size and time of writing of the bags, for fingerprints.
  const std::string& identity() const { return identity_; }

 private:
  std::vector<std::unique_ptr<rosbag::Bag>> bags_;
  std::string paths_;
  std::string identity_;
};

/// Makes sure that a bag was closed and is whole: its index begins where its header says and ends
/// with the file. Reads a few bytes only of what comes before.
///
/// @throws InvalidFile  if it is no bag of ROS 1, was not closed, or is cut; it says which.
void requireWholeBag(const std::string& path);

/// The message as a type.
/// @throws InvalidFile  if it is of another type.
template <typename Message>
typename Message::ConstPtr messageAs(const rosbag::MessageInstance& instance) {
  const auto message = instance.instantiate<Message>();
  if (!message) {
    throw pcrb::InvalidFile("topic " + instance.getTopic(), 0, instance.getDataType(),
                            ros::message_traits::DataType<Message>::value());
  }
  return message;
}

}  // namespace pcrb_tools
