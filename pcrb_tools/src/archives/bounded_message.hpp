#pragma once

#include <ros/message_traits.h>
#include <ros/serialization.h>

#include <cstdint>
#include <vector>

namespace pcrb_tools {

/// A message that is read from bytes of strangers: a list that claims to be longer than the bytes
/// that are left is refused before it takes memory.
template <typename Message>
struct BoundedMessage {
  Message message;
};

/// The bytes of a message, for ros::serialization.
class BoundedStream : public ros::serialization::IStream {
 public:
  using ros::serialization::IStream::IStream;

  template <typename Value>
  void next(Value& value) {
    ros::serialization::deserialize(*this, value);
  }

  template <typename Element, typename Allocator>
  void next(std::vector<Element, Allocator>& list) {
    BoundedStream ahead = *this;
    std::uint32_t count = 0;
    ahead.next(count);
    const std::uint64_t smallest = ros::serialization::serializationLength(Element());
    if (count * smallest > ahead.getLength()) ros::serialization::throwStreamOverrun();
    ros::serialization::deserialize(*this, list);
  }
};

}  // namespace pcrb_tools

namespace ros {
namespace message_traits {

template <typename Message>
struct MD5Sum<pcrb_tools::BoundedMessage<Message>> : MD5Sum<Message> {};

}  // namespace message_traits

namespace serialization {

template <typename Message>
struct Serializer<pcrb_tools::BoundedMessage<Message>> {
  template <typename Stream>
  static void read(Stream& stream, pcrb_tools::BoundedMessage<Message>& bounded) {
    pcrb_tools::BoundedStream bytes(stream.getData(), stream.getLength());
    deserialize(bytes, bounded.message);
  }
};

}  // namespace serialization
}  // namespace ros
