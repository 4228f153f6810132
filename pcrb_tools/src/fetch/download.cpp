#include "fetch/download.hpp"

#include <curl/curl.h>
#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <memory>
#include <string_view>
#include <thread>
#include <utility>

#include "fetch/transfer.hpp"
#include "pcrb_core/error.hpp"
#include "pcrb_core/io/text.hpp"

namespace pcrb_tools {
namespace {

using Url = std::unique_ptr<CURLU, void (*)(CURLU*)>;
using CurlText = std::unique_ptr<char, void (*)(void*)>;

std::string unescaped(const std::string& html) {
  std::string text = html;
  for (std::size_t at = text.find("&amp;"); at != std::string::npos;
       at = text.find("&amp;", at + 1)) {
    text.replace(at, 5, "&");
  }
  return text;
}

/// The value of an attribute of a tag, in double quotes.
std::optional<std::string> attribute(const std::string& tag, const std::string& name) {
  const std::string begin = " " + name + "=\"";
  const std::size_t at = tag.find(begin);
  if (at == std::string::npos) return std::nullopt;
  const std::size_t value = at + begin.size();
  const std::size_t end = tag.find('"', value);
  if (end == std::string::npos) return std::nullopt;
  return unescaped(tag.substr(value, end - value));
}

std::optional<std::string> part(CURLU* url, CURLUPart which) {
  char* text = nullptr;
  if (curl_url_get(url, which, &text, 0) != CURLUE_OK) return std::nullopt;
  const CurlText owner(text, &curl_free);
  return std::string(text);
}

bool isGoogle(const std::string& host) {
  return pcrb::endsWith(host, ".google.com") || pcrb::endsWith(host, ".googleusercontent.com");
}

/// Adds `name=value` to the URL's query.
bool append(CURLU* url, const std::string& name, const std::string& value) {
  return curl_url_set(url, CURLUPART_QUERY, (name + "=" + value).c_str(),
                      CURLU_APPENDQUERY | CURLU_URLENCODE) == CURLUE_OK;
}

namespace fs = std::filesystem;
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
      const TransferResult result =
          transfer_.fetch(url, file_.url, part_, file_.google_drive, mostBytes());
      if (result.outcome == TransferResult::Outcome::kComplete && !result.html.empty()) {
        url = confirm(result, is_confirmed);
        is_confirmed = true;
        continue;
      }
      if (result.outcome == TransferResult::Outcome::kComplete || isSameEnd(result)) return;
      if (result.outcome == TransferResult::Outcome::kPermanent) {
        if (result.is_too_long) removePart(part_);
        fail(file_, result.what);
      }
      if (result.outcome == TransferResult::Outcome::kRestart) removePart(part_);
      if (sizeOrZero(part_) > before) {  // it gets on: be as patient as at first
        left = policy_.attempts - 1;
        delay = policy_.first_delay;
      }
      if (left <= 0) fail(file_, result.what + " (the last of several attempts)");
      std::this_thread::sleep_for(delay);
      delay *= 2;
    }
  }

  /// Whether the connection ended without a length at the same place as the time before.
  bool isSameEnd(const TransferResult& result) {
    if (result.outcome != TransferResult::Outcome::kEnded) return false;
    const std::uintmax_t end = sizeOrZero(part_);
    return std::exchange(ended_at_, end) == end;
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
  /// A bit more than a known size: how much too long a file is says what it is.
  std::uint64_t mostBytes() const {
    constexpr std::uint64_t kMegabyte = 1000000;
    if (!file_.bytes) return file_.most_bytes;
    return std::min(*file_.bytes, file_.most_bytes - kMegabyte) + kMegabyte;
  }

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
  std::uintmax_t ended_at_ = std::numeric_limits<std::uintmax_t>::max();
};

}  // namespace

std::optional<std::string> confirmedUrl(const std::string& html, const std::string& page_url) {
  const std::size_t form = html.find("<form");
  if (form == std::string::npos) return std::nullopt;
  const std::size_t end = std::min(html.find("</form", form), html.size());
  const auto action = attribute(html.substr(form, html.find('>', form) - form), "action");
  const Url url(curl_url(), &curl_url_cleanup);
  if (!action || curl_url_set(url.get(), CURLUPART_URL, page_url.c_str(), 0) != CURLUE_OK) {
    return std::nullopt;
  }
  const auto host = part(url.get(), CURLUPART_HOST);
  // Relative actions are resolved against the page.
  if (curl_url_set(url.get(), CURLUPART_URL, action->c_str(), 0) != CURLUE_OK) return std::nullopt;
  const auto form_host = part(url.get(), CURLUPART_HOST);
  if (!host || !form_host || (*host != *form_host && !isGoogle(*form_host))) return std::nullopt;

  for (std::size_t input = html.find("<input", form); input < end;
       input = html.find("<input", input + 1)) {
    const std::string tag = html.substr(input, html.find('>', input) - input);
    const auto name = attribute(tag, "name");
    const auto value = attribute(tag, "value");
    if (name && value && !append(url.get(), *name, *value)) return std::nullopt;
  }
  return part(url.get(), CURLUPART_URL);
}

std::string pageTitle(const std::string& html) {
  const std::size_t begin = html.find("<title>");
  const std::size_t end = html.find("</title>");
  if (begin == std::string::npos || end == std::string::npos || end < begin + 7) return "";
  return html.substr(begin + 7, end - begin - 7);
}

void download(const Download& file, const DownloadPolicy& policy) {
  fs::create_directories(fs::absolute(file.destination).parent_path());
  Attempts attempts(file, policy);
  attempts.untilComplete();
  attempts.accept();
}

}  // namespace pcrb_tools
