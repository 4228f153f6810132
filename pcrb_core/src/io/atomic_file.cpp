#include "pcrb_core/io/atomic_file.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "pcrb_core/error.hpp"

namespace pcrb {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kBufferSize = 1 << 18;

[[noreturn]] void throwSystemError(const std::string& path, const char* action) {
  throw InvalidFile(path, std::string("cannot ") + action + ": " + std::strerror(errno));
}

/// The regular file that a path means: renaming onto a device or a link would replace it.
std::string resolveTarget(const std::string& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (fs::exists(status) && !fs::is_regular_file(status)) {
    throw InvalidFile(path, 0, fs::is_directory(status) ? "a folder" : "a special file",
                      "a regular file or a new name");
  }
  if (!fs::is_symlink(fs::symlink_status(path, error))) return path;
  const fs::path target = fs::canonical(path, error);
  if (error) throw InvalidFile(path, "cannot follow the link: " + error.message());
  return target.string();
}

std::string temporaryName(const std::string& path) {
  static std::atomic<unsigned> counter{0};
  const fs::path target(path);
  const std::string name = "." + target.filename().string() + "." + std::to_string(getpid()) + "-" +
                           std::to_string(counter++) + ".tmp";
  return (target.parent_path() / name).string();
}

/// Whether a name is one of temporaryName()'s, `.NAME.PID-N.tmp`, of a file whose name starts so.
bool isTemporaryName(std::string_view name, const std::string& start) {
  constexpr std::string_view kEnd = ".tmp";
  if (name.size() < kEnd.size() || name.substr(name.size() - kEnd.size()) != kEnd) return false;
  name.remove_suffix(kEnd.size());
  const std::size_t dot = name.rfind('.');
  return name.substr(0, start.size() + 1) == "." + start && dot > 0 &&
         dot != std::string_view::npos && name.find('-', dot) != std::string_view::npos &&
         name.find_first_not_of("0123456789-", dot + 1) == std::string_view::npos;
}

/// Makes a rename survive a power cut; filesystems that cannot sync folders are left alone.
void syncFolderOf(const std::string& path) {
  const fs::path folder = fs::path(path).parent_path();
  const int descriptor = open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return;
  fsync(descriptor);
  close(descriptor);
}

}  // namespace

AtomicFile::AtomicFile(const std::string& path) : path_(resolveTarget(path)) {
  buffer_.reserve(kBufferSize);
  do {  // a process that was killed may have left a name behind
    temporary_path_ = temporaryName(path_);
    descriptor_ = open(temporary_path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  } while (descriptor_ < 0 && errno == EEXIST);
  if (descriptor_ < 0) throwSystemError(path_, "create a file in its folder");
}

AtomicFile::~AtomicFile() {
  if (descriptor_ >= 0) close(descriptor_);
  if (!temporary_path_.empty()) unlink(temporary_path_.c_str());
}

void AtomicFile::write(std::string_view text) {
  if (buffer_.size() + text.size() > kBufferSize) flush();
  buffer_.append(text);
}

void AtomicFile::flush() {
  std::string_view rest(buffer_);
  while (!rest.empty()) {
    const ssize_t written = ::write(descriptor_, rest.data(), rest.size());
    if (written < 0 && errno != EINTR) fail("write");
    if (written > 0) rest.remove_prefix(static_cast<std::size_t>(written));
  }
  buffer_.clear();
}

void AtomicFile::commit() {
  flush();
  if (fsync(descriptor_) != 0) fail("write");
  const int closed = close(descriptor_);
  descriptor_ = -1;
  if (closed != 0) fail("write");
  if (std::rename(temporary_path_.c_str(), path_.c_str()) != 0) fail("rename the finished file");
  temporary_path_.clear();
  syncFolderOf(path_);
}

void AtomicFile::fail(const char* action) const { throwSystemError(path_, action); }

void writeFileAtomically(const std::string& path, std::string_view text) {
  AtomicFile file(path);
  file.write(text);
  file.commit();
}

void removeTemporaryFiles(const std::string& folder, const std::string& name) {
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (isTemporaryName(entry.path().filename().string(), name)) fs::remove(entry.path());
  }
}

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
    throw InvalidFile(path, std::string("cannot be locked: ") + std::strerror(error) +
                                ": does its file system refuse locks, as NFS may? Put this folder "
                                "on a local disk");
  }
}

FileLock::~FileLock() {
  if (descriptor_ >= 0) close(descriptor_);
}

}  // namespace pcrb
