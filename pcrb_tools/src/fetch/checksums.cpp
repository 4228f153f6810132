#include "fetch/checksums.hpp"

#include <filesystem>
#include <string_view>
#include <utility>

#include "pcrb_core/error.hpp"
#include "pcrb_core/io/atomic_file.hpp"
#include "pcrb_core/io/file_bytes.hpp"
#include "pcrb_core/io/text.hpp"

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
    recorded_[std::string(line.substr(kDigits + kSeparator.size()))] = {std::string(digits),
                                                                        lines.lineNumber()};
  }
}

std::string Checksums::find(const std::string& name) const {
  const auto found = recorded_.find(name);
  return found == recorded_.end() ? std::string() : found->second.sha256;
}

void Checksums::check(const std::string& name, const std::string& path,
                      const std::string& expected) {
  const std::string sha256 = pcrb::fileSha256(path);
  if (!expected.empty() && sha256 != expected) {
    throw pcrb::InvalidFile(path, 0, "SHA-256 " + sha256, expected);
  }
  const std::string recorded = find(name);
  if (sha256 == recorded) return;
  if (expected.empty() && !recorded.empty()) {
    throw pcrb::InvalidFile(
        path, 0, "SHA-256 " + sha256,
        recorded + ", recorded in " + path_ + ":" + std::to_string(recorded_.at(name).line) +
            "; if that was of a damaged file, delete that line to take this one");
  }
  recorded_[name].sha256 = sha256;
  write();
}

void Checksums::write() {
  std::string text;
  std::size_t line = 0;
  for (auto& [name, recorded] : recorded_) {
    recorded.line = ++line;
    text += recorded.sha256 + std::string(kSeparator) + name + "\n";
  }
  pcrb::writeFileAtomically(path_, text);
}

}  // namespace pcrb_tools
