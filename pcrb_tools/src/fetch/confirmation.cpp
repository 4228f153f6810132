#include "fetch/confirmation.hpp"

#include <curl/curl.h>

#include <algorithm>
#include <memory>
#include <string_view>

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
  for (const std::string_view end : {".google.com", ".googleusercontent.com"}) {
    if (host.size() > end.size() && host.compare(host.size() - end.size(), end.size(), end) == 0) {
      return true;
    }
  }
  return false;
}

/// Adds `name=value` to the URL's query.
bool append(CURLU* url, const std::string& name, const std::string& value) {
  return curl_url_set(url, CURLUPART_QUERY, (name + "=" + value).c_str(),
                      CURLU_APPENDQUERY | CURLU_URLENCODE) == CURLUE_OK;
}

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

}  // namespace pcrb_tools
