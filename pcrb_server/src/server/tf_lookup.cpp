#include "server/tf_lookup.hpp"

#include <chrono>
#include <thread>

#include "pcrb_core/error.hpp"
#include "pcrb_server/message_conversion.hpp"

namespace pcrb {

namespace {

constexpr auto kPatience = std::chrono::milliseconds(500);
constexpr auto kPeriod = std::chrono::milliseconds(5);
constexpr int kMaxWaiting = 2;

}  // namespace

TfLookup::TfLookup(std::string target_frame, double keep)
    : target_frame_(std::move(target_frame)), buffer_(ros::Duration(keep)), listener_(buffer_) {}

bool TfLookup::waitFor(const std::string& frame, const ros::Time& stamp) {
  // On the steady clock: tf2's own wait follows ROS time, which may stand still.
  const auto deadline = std::chrono::steady_clock::now() + kPatience;
  const bool may_wait = waiting_.fetch_add(1) < kMaxWaiting;
  bool is_found = buffer_.canTransform(target_frame_, frame, stamp);
  while (!is_found && may_wait && std::chrono::steady_clock::now() < deadline) {
    std::this_thread::sleep_for(kPeriod);
    is_found = buffer_.canTransform(target_frame_, frame, stamp);
  }
  --waiting_;
  return is_found;
}

std::optional<Transform> TfLookup::operator()(const std::string& frame, const ros::Time& stamp) {
  if (!waitFor(frame, stamp)) return std::nullopt;
  try {
    return fromMessage(buffer_.lookupTransform(target_frame_, frame, stamp).transform);
  } catch (const tf2::TransformException&) {
    return std::nullopt;  // gone between the check and the look-up
  } catch (const Error&) {
    return std::nullopt;  // an infinite translation, which tf2 takes for one
  }
}

}  // namespace pcrb
