#pragma once

#include <string>

namespace pcrb {

/// A frame's name without the slash that old nodes put in front of it.
inline std::string withoutSlash(const std::string& frame) {
  return !frame.empty() && frame.front() == '/' ? frame.substr(1) : frame;
}

}  // namespace pcrb
