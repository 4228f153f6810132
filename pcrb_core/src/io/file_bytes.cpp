#include "pcrb_core/io/file_bytes.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "pcrb_core/error.hpp"

namespace pcrb {
namespace {

/// A file open for reading.
class Descriptor {
 public:
  explicit Descriptor(const std::string& path)
      // A FIFO without a writer would block here.
      : path_(path), descriptor_(open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC)) {
    if (descriptor_ < 0) fail("open");
  }
  ~Descriptor() {
    if (descriptor_ >= 0) close(descriptor_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  /// Size in bytes of the regular file that this must be.
  std::size_t size() const {
    struct stat status {};
    if (fstat(descriptor_, &status) != 0) fail("read");
    if (!S_ISREG(status.st_mode)) {
      throw InvalidFile(path_, 0, S_ISDIR(status.st_mode) ? "a folder" : "a special file",
                        "a regular file");
    }
    return static_cast<std::size_t>(status.st_size);
  }

  /// Fills up to `size` bytes; returns how many there were.
  std::size_t read(char* bytes, std::size_t size) const {
    std::size_t done = 0;
    while (done < size) {
      const ssize_t got = ::read(descriptor_, bytes + done, size - done);
      if (got < 0 && errno != EINTR) fail("read");
      if (got == 0)
        break;  // shorter than it was: the reader of the format will say what is missing
      if (got > 0) done += static_cast<std::size_t>(got);
    }
    return done;
  }

 private:
  [[noreturn]] void fail(const char* action) const {
    throw InvalidFile(path_, std::string("cannot ") + action + ": " + std::strerror(errno));
  }

  const std::string& path_;
  int descriptor_;
};

}  // namespace

FileBytes::FileBytes(const std::string& path) {
  const Descriptor file(path);
  const std::size_t size = file.size();
  bytes_.reset(new char[size]);
  size_ = file.read(bytes_.get(), size);
}

}  // namespace pcrb
