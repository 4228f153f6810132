#include "fetch/transfer.hpp"

#include <curl/curl.h>

#include <array>
#include <filesystem>
#include <memory>
#include <new>
#include <string_view>
#include <utility>

#include "fetch/response.hpp"
#include "pcrb_core/io/file_bytes.hpp"
#include "pcrb_core/io/text.hpp"

namespace pcrb_tools {
namespace {

namespace fs = std::filesystem;
constexpr long kMaxRedirections = 10;

/// The version of a file that a part is of: where it comes from and the server's mark of it.
struct PartOrigin {
  std::string source;
  std::string validator;  ///< strong ETag or Last-Modified; empty where the server gives none
};

PartOrigin readOrigin(const std::string& part) {
  if (!fs::is_regular_file(part + ".from")) return {};
  const pcrb::FileBytes bytes(part + ".from");
  pcrb::LineReader lines(bytes.text(), part + ".from");
  PartOrigin origin;
  std::string_view line;
  if (lines.next(line)) origin.source = line;
  if (lines.next(line)) origin.validator = line;
  return origin;
}

std::uint64_t sizeOf(const std::string& path) {
  std::error_code error;
  const std::uintmax_t size = fs::file_size(path, error);
  return error ? 0 : size;
}

bool isTransient(CURLcode code) {
  switch (code) {
    case CURLE_COULDNT_RESOLVE_HOST:
    case CURLE_COULDNT_CONNECT:
    case CURLE_PARTIAL_FILE:
    case CURLE_OPERATION_TIMEDOUT:
    case CURLE_GOT_NOTHING:
    case CURLE_SEND_ERROR:
    case CURLE_RECV_ERROR:
    case CURLE_HTTP2_STREAM:
    case CURLE_WEIRD_SERVER_REPLY:
    case CURLE_FTP_ACCEPT_TIMEOUT:
    case CURLE_FTP_WEIRD_PASV_REPLY:
      return true;
    default:
      return false;
  }
}

bool isTransientStatus(long status) { return status == 408 || status == 429 || status >= 500; }

bool cannotResume(CURLcode code) {
  return code == CURLE_RANGE_ERROR || code == CURLE_FTP_COULDNT_USE_REST ||
         code == CURLE_BAD_DOWNLOAD_RESUME;
}

/// What became of a request that began behind `before` bytes of the part file.
TransferResult judge(const Response& response, std::uint64_t before) {
  TransferResult result;
  if (!response.write_error.empty()) {
    result.what = response.write_error;
    result.is_too_long = response.offset + response.received > response.most;
  } else if (response.is_other_range) {
    result.outcome = TransferResult::Outcome::kRestart;
    result.what = "the server sends another part of the file than was asked for";
  } else if (response.is_http && response.status == 416) {
    // A complete part has no rest: `bytes */SIZE` says so.
    const bool is_whole = response.content_range == "bytes */" + std::to_string(before);
    result.outcome =
        is_whole ? TransferResult::Outcome::kComplete : TransferResult::Outcome::kRestart;
    result.what = "the server does not have the rest of the file";
  } else if (response.is_http && response.status >= 400) {
    result.outcome = isTransientStatus(response.status) ? TransferResult::Outcome::kTransient
                                                        : TransferResult::Outcome::kPermanent;
    result.what = "the server answers with status " + std::to_string(response.status);
  } else if (response.code == CURLE_OK) {
    const bool is_sure = !response.is_http || response.is_framed || !response.html.empty();
    result.outcome = is_sure ? TransferResult::Outcome::kComplete : TransferResult::Outcome::kEnded;
    if (!is_sure) result.what = "the connection ends early, or the server says no length";
  } else if (isTransient(response.code)) {
    result.outcome = TransferResult::Outcome::kTransient;
  } else if (cannotResume(response.code) && before > 0) {
    result.outcome = TransferResult::Outcome::kRestart;
  }
  return result;
}

}  // namespace

Transfer::Transfer(const DownloadPolicy& policy) : handle_(curl_easy_init()), policy_(policy) {
  if (handle_ == nullptr) throw std::bad_alloc();
  const auto set = [this](auto option, auto value) { curl_easy_setopt(handle_, option, value); };
  set(CURLOPT_NOSIGNAL, 1L);
#if CURL_AT_LEAST_VERSION(7, 85, 0)
  set(CURLOPT_PROTOCOLS_STR, "http,https,ftp,ftps");
#else
  set(CURLOPT_PROTOCOLS,
      static_cast<long>(CURLPROTO_HTTP | CURLPROTO_HTTPS | CURLPROTO_FTP | CURLPROTO_FTPS));
#endif
  set(CURLOPT_FOLLOWLOCATION, 1L);
  set(CURLOPT_MAXREDIRS, kMaxRedirections);
  set(CURLOPT_COOKIEFILE, "");  // keeps cookies in memory
  set(CURLOPT_USERAGENT, "pcrb-fetch-datasets");
  set(CURLOPT_CONNECTTIMEOUT, policy.connect_limit_s);
  set(CURLOPT_LOW_SPEED_LIMIT, 1L);
  set(CURLOPT_LOW_SPEED_TIME, policy.stall_limit_s);
  set(CURLOPT_NOPROGRESS, 0L);
  set(CURLOPT_XFERINFOFUNCTION, &Response::onProgress);
  set(CURLOPT_HEADERFUNCTION, &Response::onHeader);
  set(CURLOPT_WRITEFUNCTION, &Response::onBody);
}

Transfer::~Transfer() { curl_easy_cleanup(handle_); }

TransferResult Transfer::fetch(const std::string& url, const std::string& source,
                               const std::string& part, bool keep_html, std::uint64_t most) {
  Response response;
  response.source = source;
  response.part = part;
  response.keep_html = keep_html;
  response.most = most;
  response.policy = &policy_;
  const PartOrigin origin = readOrigin(part);
  if (origin.source == source) response.offset = sizeOf(part);
  const std::uint64_t before = response.offset;

  const std::string what = perform(url, origin.validator, response);
  TransferResult result = judge(response, before);
  if (!what.empty() && result.what.empty()) result.what = what;
  const char* effective = nullptr;
  curl_easy_getinfo(handle_, CURLINFO_EFFECTIVE_URL, &effective);
  result.effective_url = effective == nullptr ? url : effective;
  result.html = std::move(response.html);
  return result;
}

std::string Transfer::perform(const std::string& url, const std::string& validator,
                              Response& response) {
  std::array<char, CURL_ERROR_SIZE> message{};
  curl_slist* headers = nullptr;
  if (response.offset > 0 && !validator.empty()) {
    headers = curl_slist_append(nullptr, ("If-Range: " + validator).c_str());
  }
  const std::unique_ptr<curl_slist, void (*)(curl_slist*)> owner(headers, &curl_slist_free_all);
  const std::string range = std::to_string(response.offset) + "-";
  const bool is_encrypted = pcrb::startsWith(url, "https:");  // and stays so when redirected
  const auto set = [this](auto option, auto value) { curl_easy_setopt(handle_, option, value); };
  set(CURLOPT_URL, url.c_str());
#if CURL_AT_LEAST_VERSION(7, 85, 0)
  set(CURLOPT_REDIR_PROTOCOLS_STR, is_encrypted ? "https" : "http,https");
#else
  set(CURLOPT_REDIR_PROTOCOLS,
      static_cast<long>(is_encrypted ? CURLPROTO_HTTPS : CURLPROTO_HTTP | CURLPROTO_HTTPS));
#endif
  set(CURLOPT_HTTPHEADER, headers);
  set(CURLOPT_RANGE, response.offset > 0 ? range.c_str() : nullptr);
  set(CURLOPT_ERRORBUFFER, message.data());
  set(CURLOPT_HEADERDATA, &response);
  set(CURLOPT_WRITEDATA, &response);
  set(CURLOPT_XFERINFODATA, &response);
  response.code = curl_easy_perform(handle_);
  set(CURLOPT_ERRORBUFFER, static_cast<char*>(nullptr));
  response.close();
  if (response.code == CURLE_OK) return "";
  return message[0] != '\0' ? message.data() : curl_easy_strerror(response.code);
}

}  // namespace pcrb_tools
