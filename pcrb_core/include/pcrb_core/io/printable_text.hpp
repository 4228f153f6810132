#pragma once

#include <string>
#include <string_view>

namespace pcrb {

/// A stranger's text, made such that JSON and XML can hold it: each byte that is no UTF-8, each
/// control character but tab, line feed and carriage return, and U+FFFE and U+FFFF become U+FFFD.
std::string printableText(std::string_view text);

}  // namespace pcrb
