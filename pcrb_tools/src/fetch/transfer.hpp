#pragma once

#include <cstdint>
#include <string>

#include "fetch/download.hpp"

namespace pcrb_tools {

/// What came of one request to a server.
struct TransferResult {
  enum class Outcome {
    kComplete,   ///< the part file is complete, as far as the server said
    kEnded,      ///< the connection ended, and no length was said: it may have broken
    kTransient,  ///< worth another attempt from where the part file ends
    kRestart,    ///< worth another attempt without the part file
    kPermanent
  };
  Outcome outcome = Outcome::kPermanent;
  std::string what;           ///< the server's or the network's words, unless complete
  std::string html;           ///< a page that came instead of the file (Google Drive only)
  std::string effective_url;  ///< after redirections
  bool is_too_long = false;   ///< more bytes came than the file may have
};

struct Response;

/// Cookies and connections that the requests for one file share. Wraps a libcurl handle.
class Transfer {
 public:
  explicit Transfer(const DownloadPolicy& policy);
  ~Transfer();
  Transfer(const Transfer&) = delete;
  Transfer& operator=(const Transfer&) = delete;

  /// Appends to the part file what it lacks.
  ///
  /// @param source  what the file is known by, recorded in `<part>.from`: a part of another
  ///                source is begun anew. The URL of a confirmed download changes every time, this
  ///                does not.
  /// @param most    bytes that the part file may have; a response that goes on is given up.
  TransferResult fetch(const std::string& url, const std::string& source, const std::string& part,
                       bool keep_html, std::uint64_t most);

 private:
  /// Returns the network's words, unless all went well.
  std::string perform(const std::string& url, const std::string& validator, Response& response);

  void* handle_;
  const DownloadPolicy& policy_;
};

}  // namespace pcrb_tools
