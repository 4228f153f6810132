#pragma once

#include <rosbag/bag.h>

#include <memory>
#include <string>

namespace pcrb_tools {

/// A bag that appears complete or not at all: it has another name until commit().
class AtomicBag {
 public:
  /// @throws pcrb::InvalidFile  if the bag cannot be written; so do the other functions.
  explicit AtomicBag(const std::string& path);
  ~AtomicBag();
  AtomicBag(const AtomicBag&) = delete;
  AtomicBag& operator=(const AtomicBag&) = delete;

  /// To be called before the first message.
  void compress() { bag_->setCompression(rosbag::compression::LZ4); }

  /// @param header  of the connection; rosbag makes one of the message's type without it.
  template <typename Message>
  void write(const std::string& topic, const ros::Time& time, const Message& message,
             const boost::shared_ptr<ros::M_string>& header = nullptr) {
    naming([&] { bag_->write(topic, time, message, header); });
  }

  /// Checks that the disk has all of it, and gives the bag its name. Call once, last.
  void commit();

 private:
  /// Runs what rosbag may complain about, a full disk for one, and names the bag in the complaint.
  template <typename Body>
  void naming(const Body& body) {
    try {
      body();
    } catch (const ros::Exception& error) {
      fail(error.what());
    }
  }
  [[noreturn]] void fail(const std::string& reason) const;

  /// Leaves a bag undestroyed that cannot be closed, on a full disk: its destructor would throw and
  /// end the process.
  struct Closer {
    void operator()(rosbag::Bag* bag) const;
  };

  std::string path_;
  std::string temporary_path_;
  std::unique_ptr<rosbag::Bag, Closer> bag_;
};

}  // namespace pcrb_tools
