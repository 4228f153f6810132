#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>

namespace pcrb_tools {

/// One file to download by http, https or ftp.
struct Download {
  std::string url;
  std::string destination;             ///< path; until it is complete, `<destination>.part`
  bool google_drive = false;           ///< an HTML page in its place asks for a confirmation
  std::optional<std::uint64_t> bytes;  ///< what its size must be, where known
  /// Throws a pcrb::Error if the file at the path is not what it should be.
  std::function<void(const std::string& path)> check;
  /// A server that sends more is not listened to any longer.
  std::uint64_t most_bytes = std::numeric_limits<std::uint64_t>::max();
};

/// How patient a download is.
struct DownloadPolicy {
  int attempts = 6;                             ///< in a row that bring no new byte
  std::chrono::milliseconds first_delay{2000};  ///< before the second attempt; doubles every time
  long connect_limit_s = 30;
  long stall_limit_s = 60;                                                   ///< without a byte
  std::function<void(std::uint64_t done, std::uint64_t total)> on_progress;  ///< total 0 = unknown
};

/// Downloads a file, going on from `<destination>.part` where an earlier attempt or run stopped.
///
/// Interrupted transfers and server errors are tried again, others are not. Where the connection
/// ends without a length having been said, the file is asked for again, until it ends at the same
/// place twice. A file that changed on
/// the server in between (ETag, Last-Modified) is begun anew. The file gets its name only when it
/// is complete, of the right size and has passed its check; one that has not is removed.
/// @throws pcrb::Error  saying what the server or the network said.
void download(const Download& file, const DownloadPolicy& policy);

/// The address that a page of Google Drive asks for instead of sending a file that it has not
/// scanned for viruses: the action of its download form with the form's hidden fields.
///
/// @param page_url  where the page came from; the form must lead to the same host or to Google's.
/// @return          nothing if the page has no such form (a sign-in, a quota that is used up).
std::optional<std::string> confirmedUrl(const std::string& html, const std::string& page_url);

/// The text of a page's title, for messages; empty where it has none.
std::string pageTitle(const std::string& html);

}  // namespace pcrb_tools
