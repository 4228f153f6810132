#include "evaluation/writer_lock.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>

#include "pcrb_core/evaluation/results_store.hpp"

namespace pcrb {
namespace {

std::string describeThisProcess() {
  std::array<char, 256> host{};
  gethostname(host.data(), host.size() - 1);
  return "process " + std::to_string(getpid()) + " on " + host.data();
}

std::string readText(int descriptor) {
  std::array<char, 512> text;
  const ssize_t size = pread(descriptor, text.data(), text.size(), 0);
  return {text.data(), size > 0 ? static_cast<std::size_t>(size) : 0};
}

/// Who holds the lock is only said for people: a full disk must not keep a run from being read.
void noteHolder(int descriptor) {
  const std::string text = describeThisProcess();
  if (ftruncate(descriptor, 0) != 0) return;
  if (pwrite(descriptor, text.data(), text.size(), 0) < 0) return;
}

}  // namespace

WriterLock::WriterLock(const std::string& run_folder) {
  const std::string path = run_folder + "/results.lock";
  descriptor_ = open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (descriptor_ < 0) throw StoreError(path + ": cannot open it: " + std::strerror(errno));
  int status = flock(descriptor_, LOCK_EX | LOCK_NB);
  while (status != 0 && errno == EINTR) status = flock(descriptor_, LOCK_EX | LOCK_NB);
  if (status == 0) {
    noteHolder(descriptor_);
    return;
  }
  const int error = errno;
  const std::string holder = readText(descriptor_);
  close(descriptor_);
  if (error != EWOULDBLOCK) throw StoreError(path + ": cannot lock it: " + std::strerror(error));
  throw StoreError(run_folder + ": found another writer (" + holder +
                   "), expected none: a run folder takes one at a time");
}

WriterLock::~WriterLock() { close(descriptor_); }

}  // namespace pcrb
