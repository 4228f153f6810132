#pragma once

#include <rosbag/bag.h>
#include <rosbag/message_instance.h>

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "archives/bounded_message.hpp"
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
  /// @throws InvalidFile  if a bag cannot be opened; one that was not closed, is damaged, or has a
  ///                      chunk that memory has no room for is named as such.
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

/// The message as a type; null if it is of another.
///
/// Takes memory for what the message has, whatever it claims to have.
/// @throws ros::serialization::StreamOverrunException  if it claims more.
template <typename Message>
typename Message::ConstPtr messageIf(const rosbag::MessageInstance& instance) {
  const auto bounded = instance.instantiate<BoundedMessage<Message>>();
  return bounded ? typename Message::ConstPtr(bounded, &bounded->message) : nullptr;
}

/// The message as a type.
/// @throws InvalidFile  if it is of another type.
template <typename Message>
typename Message::ConstPtr messageAs(const rosbag::MessageInstance& instance) {
  const auto message = messageIf<Message>(instance);
  if (!message) {
    throw pcrb::InvalidFile("topic " + instance.getTopic(), 0, instance.getDataType(),
                            ros::message_traits::DataType<Message>::value());
  }
  return message;
}

}  // namespace pcrb_tools
