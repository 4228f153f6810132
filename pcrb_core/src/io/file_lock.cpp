#include "pcrb_core/io/file_lock.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>

#include "pcrb_core/error.hpp"

namespace pcrb {
namespace {

std::string describeThisProcess() {
  std::array<char, 256> host{};
  gethostname(host.data(), host.size() - 1);
  return "process " + std::to_string(getpid()) + " on " + host.data();
}

std::string readHolder(int descriptor) {
  std::array<char, 512> text;
  const ssize_t size = pread(descriptor, text.data(), text.size(), 0);
  return size > 0 ? std::string(text.data(), static_cast<std::size_t>(size)) : "another process";
}

/// Who holds the lock is only said for people: a full disk must not keep a run from being read.
void noteHolder(int descriptor) {
  const std::string text = describeThisProcess();
  if (ftruncate(descriptor, 0) != 0) return;
  if (pwrite(descriptor, text.data(), text.size(), 0) < 0) return;
}

}  // namespace

FileLock::FileLock(const std::string& path) {
  descriptor_ = open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (descriptor_ < 0) {
    throw InvalidFile(path, std::string("cannot be opened: ") + std::strerror(errno));
  }
  int status = flock(descriptor_, LOCK_EX | LOCK_NB);
  while (status != 0 && errno == EINTR) status = flock(descriptor_, LOCK_EX | LOCK_NB);
  if (status == 0) {
    noteHolder(descriptor_);
    return;
  }
  const int error = errno;
  holder_ = readHolder(descriptor_);
  close(descriptor_);
  descriptor_ = -1;
  if (error != EWOULDBLOCK) {
    throw InvalidFile(path, std::string("cannot be locked: ") + std::strerror(error));
  }
}

FileLock::~FileLock() {
  if (descriptor_ >= 0) close(descriptor_);
}

}  // namespace pcrb
