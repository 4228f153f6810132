#include "pcrb_tools/fetch/checksums.hpp"

#include <filesystem>
#include <string_view>
#include <utility>

#include "pcrb_core/error.hpp"
#include "pcrb_core/io/atomic_file.hpp"
#include "pcrb_core/io/file_bytes.hpp"
#include "pcrb_core/io/file_hash.hpp"
#include "pcrb_core/io/text_rows.hpp"

namespace pcrb_tools {
namespace {

constexpr std::size_t kDigits = 64;
constexpr std::string_view kSeparator = "  ";

}  // namespace

Checksums::Checksums(std::string path) : path_(std::move(path)) {
  if (!std::filesystem::exists(path_)) return;
  const pcrb::FileBytes bytes(path_);
  pcrb::LineReader lines(bytes.text(), path_);
  std::string_view line;
  while (lines.next(line)) {
    const std::string_view digits = line.substr(0, kDigits);
    const bool is_row = line.size() > kDigits + kSeparator.size() &&
                        line.substr(kDigits, kSeparator.size()) == kSeparator &&
                        digits.find_first_not_of("0123456789abcdef") == std::string_view::npos;
    if (!is_row) lines.fail(pcrb::inQuotes(line), "64 hexadecimal digits, two blanks and a name");
    sha256_of_[std::string(line.substr(kDigits + kSeparator.size()))] = digits;
  }
}

std::string Checksums::find(const std::string& name) const {
  const auto found = sha256_of_.find(name);
  return found == sha256_of_.end() ? std::string() : found->second;
}

void Checksums::check(const std::string& name, const std::string& path,
                      const std::string& expected) {
  const std::string sha256 = pcrb::fileSha256(path);
  const std::string recorded = find(name);
  for (const std::string& known : {expected, recorded}) {
    if (!known.empty() && known != sha256) {
      throw pcrb::InvalidFile(path, 0, "SHA-256 " + sha256,
                              known + (known == recorded ? ", recorded in " + path_ : ""));
    }
  }
  if (!recorded.empty()) return;
  sha256_of_[name] = sha256;
  std::string text;
  for (const auto& [other, digits] : sha256_of_) text += digits + "  " + other + "\n";
  pcrb::writeFileAtomically(path_, text);
}

}  // namespace pcrb_tools
