#pragma once

#include <curl/curl.h>

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>
#include <string_view>

#include "fetch/download.hpp"

namespace pcrb_tools {

/// What has been received of a response so far; the body goes into the part file as it comes.
struct Response {
  std::string source;
  std::string part;
  bool keep_html = false;
  std::uint64_t offset = 0;  ///< bytes of the part file that the body is appended to
  std::uint64_t most = 0;    ///< bytes that the part file may have
  const DownloadPolicy* policy = nullptr;

  bool is_http = false;
  long status = 0;
  bool is_framed = false;  ///< the end of the body can be told from the end of the connection
  bool is_html = false;
  std::string etag;
  std::string last_modified;
  std::string content_range;
  std::string html;             ///< the body, where it is a page that is to be kept
  bool is_other_range = false;  ///< the server did not send what was asked for
  std::string write_error;
  std::uint64_t received = 0;  ///< bytes of the body
  CURLcode code = CURLE_OK;    ///< how the request ended
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file{nullptr, &std::fclose};

  /// One line of the headers; those of redirections come before those of the final response.
  void readHeader(std::string_view line);
  /// Opens the part file and records what it is a part of.
  bool open();
  bool write(const char* bytes, std::size_t n);
  void close();

  static std::size_t onHeader(char* bytes, std::size_t, std::size_t n, void* self) {
    static_cast<Response*>(self)->readHeader({bytes, n});
    return n;
  }
  static std::size_t onBody(char* bytes, std::size_t, std::size_t n, void* self) {
    return static_cast<Response*>(self)->write(bytes, n) ? n : 0;
  }
  static int onProgress(void* self, curl_off_t total, curl_off_t done, curl_off_t, curl_off_t) {
    const Response& response = *static_cast<Response*>(self);
    if (response.policy->on_progress && response.file) {
      const std::uint64_t end = total > 0 ? response.offset + static_cast<std::uint64_t>(total) : 0;
      response.policy->on_progress(response.offset + static_cast<std::uint64_t>(done), end);
    }
    return 0;
  }
};

}  // namespace pcrb_tools
