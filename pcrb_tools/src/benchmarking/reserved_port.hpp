#pragma once

namespace pcrb_tools {

/// A TCP port of the loopback interface that the system gives to nobody who asks for any free one
/// as long as this object lives. A program that binds it by its number with SO_REUSEADDR, as ROS
/// masters do, gets it.
class ReservedPort {
 public:
  /// @throws pcrb::Error  if no port is free.
  ReservedPort();
  ~ReservedPort();
  ReservedPort(const ReservedPort&) = delete;
  ReservedPort& operator=(const ReservedPort&) = delete;

  int number() const { return number_; }

 private:
  int socket_ = -1;
  int number_ = 0;
};

}  // namespace pcrb_tools
