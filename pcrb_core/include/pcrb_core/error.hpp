#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>

namespace pcrb {

/// Base of every exception that this library throws on purpose.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A file that cannot be read, is malformed, or cannot be written.
class InvalidFile : public Error {
 public:
  /// Message: `path:line: found FOUND, expected EXPECTED`; line 0 means the file as a whole.
  InvalidFile(const std::string& path, std::size_t line, const std::string& found,
              const std::string& expected)
      : Error(path + (line > 0 ? ":" + std::to_string(line) : std::string()) + ": found " + found +
              ", expected " + expected) {}

  /// Message: `path: what`, for failures that have no found and expected (permissions, full disk).
  InvalidFile(const std::string& path, const std::string& what) : Error(path + ": " + what) {}
};

/// A registration problem, or its clouds, that cannot be posed or scored.
class InvalidProblem : public Error {
 public:
  using Error::Error;
};

/// A parameter that is unknown, of the wrong type or out of range.
class InvalidParameter : public Error {
 public:
  using Error::Error;
};

}  // namespace pcrb
