#include "bags/scene_bag.hpp"

#include <ros/message_traits.h>

namespace pcrb_tools {
namespace {

constexpr const char* kPlayer = "/pcrb/replay";

/// What the bag keeps of a publisher.
template <typename Message>
boost::shared_ptr<ros::M_string> connectionHeader(const std::string& topic, bool is_latched) {
  namespace traits = ros::message_traits;
  const auto header = boost::make_shared<ros::M_string>();
  *header = {{"callerid", kPlayer},
             {"latching", is_latched ? "1" : "0"},
             {"md5sum", traits::MD5Sum<Message>::value()},
             {"message_definition", traits::Definition<Message>::value()},
             {"topic", topic},
             {"type", traits::DataType<Message>::value()}};
  return header;
}

}  // namespace

SceneBag::SceneBag(const std::string& path, bool compress) : bag_(path) {
  if (compress) bag_.compress();
}

void SceneBag::write(const pcrb::Scene& scene) {
  pcrb::forEachMessage(scene, [&](const char* name, const auto& message, bool is_latched) {
    using Message = std::decay_t<decltype(message)>;
    const bool is_absolute = name[0] == '/';
    const std::string topic =
        is_absolute ? name : std::string("/") + pcrb::kDefaultNamespace + "/" + name;
    bag_.write(topic, scene.dueAt(name), message, connectionHeader<Message>(topic, is_latched));
  });
}

}  // namespace pcrb_tools
