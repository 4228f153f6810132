#pragma once

#include <optional>
#include <string>

namespace pcrb_tools {

/// The address that a page of Google Drive asks for instead of sending a file that it has not
/// scanned for viruses: the action of its download form with the form's hidden fields.
///
/// @param page_url  where the page came from; the form must lead to the same host or to Google's.
/// @return          nothing if the page has no such form (a sign-in, a quota that is used up).
std::optional<std::string> confirmedUrl(const std::string& html, const std::string& page_url);

/// The text of a page's title, for messages; empty where it has none.
std::string pageTitle(const std::string& html);

}  // namespace pcrb_tools
