#include "pcrb_core/io/printable_text.hpp"

#include <boost/locale/utf.hpp>

namespace pcrb {
namespace {

namespace utf = boost::locale::utf;

bool isCharacter(utf::code_point c) { return c != utf::illegal && c != utf::incomplete; }

bool isPrintable(utf::code_point c) {
  if (c == '\t' || c == '\n' || c == '\r') return true;
  return isCharacter(c) && c >= 0x20 && c != 0x7f && c != 0xfffe && c != 0xffff;
}

}  // namespace

std::string printableText(std::string_view text) {
  constexpr const char* kReplacement = "\xef\xbf\xbd";
  std::string result;
  const char* const end = text.data() + text.size();
  for (const char* at = text.data(); at != end;) {
    const char* behind = at;
    const utf::code_point c = utf::utf_traits<char>::decode(behind, end);
    if (!isCharacter(c)) behind = at + 1;  // what follows that byte may be one
    if (isPrintable(c)) {
      result.append(at, behind);
    } else {
      result += kReplacement;
    }
    at = behind;
  }
  return result;
}

}  // namespace pcrb
