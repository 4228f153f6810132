#include "bags/scene_bag.hpp"

#include <fcntl.h>
#include <ros/message_traits.h>
#include <unistd.h>

#include <filesystem>
#include <functional>
#include <system_error>

#include "pcrb_core/error.hpp"

namespace pcrb_tools {
namespace {

namespace fs = std::filesystem;

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

/// Runs what rosbag may complain about; a full disk is one such complaint.
void naming(const std::string& path, const std::function<void()>& body) {
  try {
    body();
  } catch (const ros::Exception& error) {
    throw pcrb::InvalidFile(path, "cannot be written: " + std::string(error.what()));
  }
}

std::string temporaryName(const std::string& path) {
  const fs::path final_path(path);
  return (final_path.parent_path() / ("." + final_path.filename().string() + ".tmp")).string();
}

/// rosbag does not look at what closing says, so the bag is read again.
void requireComplete(const std::string& path) {
  const rosbag::Bag complete(path, rosbag::bagmode::Read);
  const int descriptor = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  const bool is_on_disk = descriptor >= 0 && fsync(descriptor) == 0;
  if (descriptor >= 0) close(descriptor);
  if (!is_on_disk) throw rosbag::BagIOException("fsync failed");
}

}  // namespace

SceneBag::SceneBag(const std::string& path, bool compress)
    : path_(path), temporary_path_(temporaryName(path)), bag_(new rosbag::Bag) {
  naming(path_, [&] { bag_->open(temporary_path_, rosbag::bagmode::Write); });
  if (compress) bag_->setCompression(rosbag::compression::LZ4);
}

void SceneBag::Closer::operator()(rosbag::Bag* bag) const {
  try {
    bag->close();
    delete bag;
  } catch (const ros::Exception&) {
    // Reported by the call that wrote.
  }
}

SceneBag::~SceneBag() {
  bag_.reset();
  std::error_code ignored;
  fs::remove(temporary_path_, ignored);
}

void SceneBag::write(const pcrb::Scene& scene) {
  naming(path_, [&] {
    pcrb::forEachMessage(scene, [&](const char* name, const auto& message, bool is_latched) {
      using Message = std::decay_t<decltype(message)>;
      const bool is_absolute = name[0] == '/';
      const std::string topic =
          is_absolute ? name : std::string("/") + pcrb::kDefaultNamespace + "/" + name;
      bag_->write(topic, scene.dueAt(name), message, connectionHeader<Message>(topic, is_latched));
    });
  });
}

void SceneBag::commit() {
  naming(path_, [&] {
    bag_->close();
    requireComplete(temporary_path_);
  });
  std::error_code error;
  fs::rename(temporary_path_, path_, error);
  if (error) throw pcrb::InvalidFile(path_, "cannot be written: " + error.message());
}

}  // namespace pcrb_tools
