#include "fetch/download.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <filesystem>
#include <thread>

#include "fetch/confirmation.hpp"
#include "fetch/transfer.hpp"
#include "pcrb_core/error.hpp"
#include "pcrb_core/io/text.hpp"

namespace pcrb_tools {
namespace {

namespace fs = std::filesystem;
using Outcome = TransferResult::Outcome;

void removePart(const std::string& part) {
  fs::remove(part);
  fs::remove(part + ".from");
}

std::uintmax_t sizeOrZero(const std::string& path) {
  std::error_code error;
  const std::uintmax_t size = fs::file_size(path, error);
  return error ? 0 : size;
}

[[noreturn]] void fail(const Download& file, const std::string& what) {
  throw pcrb::InvalidFile(file.destination, "cannot be downloaded from " + file.url + ": " + what);
}

/// The attempts at one file.
class Attempts {
 public:
  Attempts(const Download& file, const DownloadPolicy& policy)
      : file_(file), policy_(policy), transfer_(policy), part_(file.destination + ".part") {}

  void untilComplete() {
    std::string url = file_.url;
    bool is_confirmed = false;
    auto delay = policy_.first_delay;
    for (int left = policy_.attempts - 1;; --left) {
      const std::uintmax_t before = sizeOrZero(part_);
      const TransferResult result = transfer_.fetch(url, file_.url, part_, file_.google_drive);
      if (result.outcome == Outcome::kComplete && !result.html.empty()) {
        url = confirm(result, is_confirmed);
        is_confirmed = true;
        continue;
      }
      if (result.outcome == Outcome::kComplete) return;
      if (result.outcome == Outcome::kPermanent) fail(file_, result.what);
      if (result.outcome == Outcome::kRestart) removePart(part_);
      if (sizeOrZero(part_) > before) {  // it gets on: be as patient as at first
        left = policy_.attempts - 1;
        delay = policy_.first_delay;
      }
      if (left <= 0) fail(file_, result.what + " (the last of several attempts)");
      std::this_thread::sleep_for(delay);
      delay *= 2;
    }
  }

  void accept() {
    if (!fs::is_regular_file(part_)) fail(file_, "the server sends an empty file");
    try {
      requireSize();
      if (file_.check) file_.check(part_);
    } catch (const pcrb::Error&) {
      removePart(part_);
      throw;
    }
    syncToDisk();
    fs::rename(part_, file_.destination);
    fs::remove(part_ + ".from");
  }

 private:
  std::string confirm(const TransferResult& page, bool is_confirmed) const {
    const auto url = is_confirmed ? std::nullopt : confirmedUrl(page.html, page.effective_url);
    if (!url) {
      fail(file_,
           "an HTML page comes instead of the file" +
               (pageTitle(page.html).empty() ? "" : ", " + pcrb::inQuotes(pageTitle(page.html))) +
               "; download it in a browser and use --from");
    }
    return *url;
  }

  void requireSize() const {
    const std::uintmax_t size = fs::file_size(part_);
    if (file_.bytes && size != *file_.bytes) {
      fail(file_,
           "found " + std::to_string(size) + " bytes, expected " + std::to_string(*file_.bytes));
    }
  }

  void syncToDisk() const {
    const int descriptor = ::open(part_.c_str(), O_RDONLY | O_CLOEXEC);
    const bool is_synced = descriptor >= 0 && ::fsync(descriptor) == 0;
    if (descriptor >= 0) ::close(descriptor);
    if (!is_synced) throw pcrb::InvalidFile(part_, "cannot be written to the disk");
  }

  const Download& file_;
  const DownloadPolicy& policy_;
  Transfer transfer_;
  std::string part_;
};

}  // namespace

void download(const Download& file, const DownloadPolicy& policy) {
  fs::create_directories(fs::absolute(file.destination).parent_path());
  Attempts attempts(file, policy);
  attempts.untilComplete();
  attempts.accept();
}

}  // namespace pcrb_tools
