#include "benchmarking/log_notices.hpp"

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>
#include <regex>
#include <utility>

#include "pcrb_core/io/text.hpp"

namespace pcrb_tools {
namespace {

constexpr std::size_t kMostErrors = 8;
constexpr std::size_t kLongestError = 300;  // letters
constexpr const char* kTraceback = "Traceback (most recent call last):";
constexpr std::array<const char*, 4> kSpeakers{"benchmark_server", "localization_bridge",
                                               "node_supervisor", "registration_node"};

std::string withoutColours(const std::string& line) {
  static const std::regex kColour("\033\\[[0-9;]*m|\033\\][^\a]*\a");
  return std::regex_replace(line, kColour, "");
}

/// The node of the suite that tells people a line; empty for other lines.
std::string speakerOf(const std::string& line) {
  for (const std::string speaker : kSpeakers) {
    if (pcrb::startsWith(line, "[" + speaker + "] ")) return speaker;
  }
  return "";
}

}  // namespace

std::string errorOfNode(const std::string& line) {
  static const std::regex kRosconsole(R"(^\[ ?(ERROR|FATAL)\] \[[^\]]*\]:? ?)");
  static const std::regex kDeath(
      R"(^\[(?!pcrb/)\S+-\d+\] process has died \[pid \d+, (exit code -?\d+))");
  const std::string text = withoutColours(line);
  std::smatch found;
  if (std::regex_search(text, found, kRosconsole)) {
    return "[" + found.str(1) + "] " + found.suffix().str();
  }
  if (std::regex_search(text, found, kDeath)) {
    return text.substr(0, text.find(']') + 1) + " process has died, " + found.str(1);
  }
  const bool is_error = pcrb::startsWith(text, "ERROR: cannot launch") ||
                        pcrb::startsWith(text, "  what(): ") ||
                        text.find("error while loading shared libraries") != std::string::npos;
  return is_error ? text.substr(text.find_first_not_of(' ')) : "";
}

LogNotices::LogNotices(std::string path, std::streamoff start)
    : path_(std::move(path)), place_(start) {}

std::vector<std::string> LogNotices::next(bool with_errors) {
  std::vector<std::string> texts;
  std::ifstream log(path_, std::ios::binary);
  if (!log.seekg(place_)) return texts;
  const std::string written{std::istreambuf_iterator<char>(log), {}};
  place_ += static_cast<std::streamoff>(written.size());
  unfinished_ += written;
  std::size_t begin = 0;
  for (std::size_t end = unfinished_.find('\n'); end != std::string::npos;
       end = unfinished_.find('\n', begin)) {
    take(unfinished_.substr(begin, end - begin), with_errors, texts);
    begin = end + 1;
  }
  unfinished_.erase(0, begin);
  finishNotice(texts);  // nodes write what they tell in one piece
  return texts;
}

std::string LogNotices::last(const std::string& node) const {
  const auto told = told_.find(node);
  return told == told_.end() ? "" : told->second;
}

void LogNotices::take(const std::string& line, bool with_errors, std::vector<std::string>& texts) {
  if (!speaker_.empty() && pcrb::startsWith(line, "  ")) {
    text_ += "\n" + pcrb::printableText(line);
    return;
  }
  finishNotice(texts);
  speaker_ = speakerOf(line);
  if (!speaker_.empty()) text_ = pcrb::printableText(line.substr(speaker_.size() + 3));
  if (!speaker_.empty() || !with_errors) return;
  const bool is_end_of_traceback = is_traceback_ && !line.empty() && line.front() != ' ';
  takeError(is_end_of_traceback ? line : errorOfNode(line), texts);
  is_traceback_ = pcrb::startsWith(line, kTraceback) || (is_traceback_ && !is_end_of_traceback);
}

void LogNotices::finishNotice(std::vector<std::string>& texts) {
  if (speaker_.empty()) return;
  std::string& told = told_[speaker_];
  if (told != text_) texts.push_back(speaker_ + ": " + text_);
  told = text_;
  speaker_.clear();
}

void LogNotices::takeError(const std::string& text, std::vector<std::string>& texts) {
  if (text.empty() || errors_.size() >= kMostErrors) return;
  const std::string shown = pcrb::printableText(text.substr(0, kLongestError));
  if (errors_.insert(shown).second) texts.push_back("node under test: " + shown);
}

}  // namespace pcrb_tools
