#include "fetch/response.hpp"

#include <algorithm>

#include "pcrb_core/error.hpp"
#include "pcrb_core/io/atomic_file.hpp"
#include "pcrb_core/io/number.hpp"
#include "pcrb_core/io/text.hpp"

namespace pcrb_tools {
namespace {

constexpr std::size_t kMaxHtml = 4 << 20;

}  // namespace

void Response::readHeader(std::string_view line) {
  if (pcrb::startsWith(line, "HTTP/")) {
    is_http = true;  // of a redirection or of the final response: forget the last
    is_framed = !pcrb::startsWith(line, "HTTP/1.");
    is_html = false;
    etag.clear();
    last_modified.clear();
    content_range.clear();
    const std::size_t blank = line.find(' ');
    if (blank != std::string_view::npos) {
      status = static_cast<long>(pcrb::parseInt(line.substr(blank + 1, 3)).value_or(0));
    }
    return;
  }
  const std::size_t colon = line.find(':');
  if (colon == std::string_view::npos) return;
  const std::string name = pcrb::inSmallLetters(line.substr(0, colon));
  std::string_view value = line.substr(colon + 1);
  while (!value.empty() && (value.back() == '\r' || value.back() == '\n')) value.remove_suffix(1);
  value = pcrb::trimmed(value);
  if (name == "etag" && !pcrb::startsWith(value, "W/")) etag = value;
  if (name == "last-modified") last_modified = value;
  if (name == "content-range") content_range = value;
  if (name == "content-length" || name == "transfer-encoding") is_framed = true;
  if (name == "content-type") is_html = pcrb::inSmallLetters(value).find("text/html") == 0;
}

bool Response::open() {
  // 200 to a request for a rest: the server sends the whole file, of another version or always.
  if (is_http && status != 206) offset = 0;
  const std::string expected = "bytes " + std::to_string(offset) + "-";
  is_other_range = offset > 0 && is_http && !pcrb::startsWith(content_range, expected);
  if (is_other_range) return false;
  file.reset(std::fopen(part.c_str(), offset == 0 ? "wb" : "ab"));
  if (!file) {
    write_error = part + ": cannot be written";
    return false;
  }
  if (offset == 0) {  // after the old bytes are gone: they are not of this origin
    pcrb::writeFileAtomically(part + ".from",
                              source + "\n" + (etag.empty() ? last_modified : etag) + "\n");
  }
  return true;
}

bool Response::write(const char* bytes, std::size_t n) {
  if (is_http && status >= 400) return true;  // an error page
  if (keep_html && is_html) {
    html.append(bytes, std::min(n, kMaxHtml - html.size()));
    return true;
  }
  try {
    if (!file && !open()) return false;
  } catch (const pcrb::Error& error) {
    write_error = error.what();
    return false;
  }
  received += n;
  if (offset + received > most) {
    write_error = "found more than " + std::to_string(most) + " bytes, expected at most so many";
    return false;
  }
  if (std::fwrite(bytes, 1, n, file.get()) == n) return true;
  write_error = part + ": cannot be written (disk full?)";
  return false;
}

void Response::close() {
  if (file && std::fclose(file.release()) != 0 && write_error.empty()) {
    write_error = part + ": cannot be written (disk full?)";
  }
}

}  // namespace pcrb_tools
