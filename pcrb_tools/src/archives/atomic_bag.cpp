#include "archives/atomic_bag.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <filesystem>
#include <system_error>

#include "pcrb_core/error.hpp"

namespace pcrb_tools {
namespace {

namespace fs = std::filesystem;

std::string temporaryBagName(const std::string& path) {
  const fs::path final_path(path);
  return (final_path.parent_path() / ("." + final_path.filename().string() + ".tmp")).string();
}

/// rosbag does not look at what closing says, so the bag is read again.
void requireCompleteBag(const std::string& path) {
  const rosbag::Bag complete(path, rosbag::bagmode::Read);
  const int descriptor = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  const bool is_on_disk = descriptor >= 0 && fsync(descriptor) == 0;
  if (descriptor >= 0) close(descriptor);
  if (!is_on_disk) throw rosbag::BagIOException("fsync failed");
}

}  // namespace

AtomicBag::AtomicBag(const std::string& path)
    : path_(path), temporary_path_(temporaryBagName(path)), bag_(new rosbag::Bag) {
  naming([&] { bag_->open(temporary_path_, rosbag::bagmode::Write); });
}

void AtomicBag::fail(const std::string& reason) const {
  throw pcrb::InvalidFile(path_, "cannot be written: " + reason);
}

void AtomicBag::Closer::operator()(rosbag::Bag* bag) const {
  try {
    bag->close();
    delete bag;
  } catch (const ros::Exception&) {
    // Reported by the call that wrote.
  }
}

AtomicBag::~AtomicBag() {
  bag_.reset();
  std::error_code ignored;
  fs::remove(temporary_path_, ignored);
}

void AtomicBag::commit() {
  naming([&] {
    bag_->close();
    requireCompleteBag(temporary_path_);
  });
  std::error_code error;
  fs::rename(temporary_path_, path_, error);
  if (error) fail(error.message());
}

}  // namespace pcrb_tools
