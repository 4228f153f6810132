#include "preparation/overlap_journal.hpp"

#include <filesystem>
#include <optional>
#include <string_view>
#include <utility>

#include "pcrb_core/error.hpp"
#include "pcrb_core/io/file_bytes.hpp"
#include "pcrb_core/io/number.hpp"
#include "pcrb_core/io/text.hpp"

namespace pcrb_tools {
namespace {

/// `target value value …`; nothing for a line that is not whole.
std::optional<std::pair<std::size_t, std::vector<double>>> parseColumn(std::string_view line,
                                                                       std::size_t size) {
  std::vector<std::string_view> fields;
  pcrb::splitAtBlanks(line, fields);
  if (fields.size() != size + 1) return std::nullopt;
  const auto target = pcrb::parseUnsigned(fields[0]);
  if (!target || *target >= size) return std::nullopt;
  std::vector<double> column;
  for (std::size_t i = 1; i < fields.size(); ++i) {
    const auto value = pcrb::parseDouble(fields[i]);
    if (!value || *value < 0.0 || *value > 1.0) return std::nullopt;  // nan: not computed
    column.push_back(*value);
  }
  return std::make_pair(static_cast<std::size_t>(*target), std::move(column));
}

}  // namespace

OverlapJournal::OverlapJournal(std::string path, const std::string& made_from, std::size_t size)
    : path_(std::move(path)) {
  const std::size_t kept = readKnown(made_from, size);
  if (kept > 0) std::filesystem::resize_file(path_, kept);
  file_.open(path_, std::ios::binary | (kept > 0 ? std::ios::app : std::ios::trunc));
  if (kept == 0) file_ << made_from << std::flush;
  if (!file_) throw pcrb::InvalidFile(path_, "cannot be written");
}

std::size_t OverlapJournal::readKnown(const std::string& made_from, std::size_t size) {
  if (!std::filesystem::is_regular_file(path_)) return 0;
  const pcrb::FileBytes bytes(path_);
  std::string_view rest = bytes.text();
  if (rest.substr(0, made_from.size()) != made_from) return 0;
  rest.remove_prefix(made_from.size());
  for (std::size_t end = rest.find('\n'); end != std::string_view::npos; end = rest.find('\n')) {
    auto column = parseColumn(rest.substr(0, end), size);
    if (!column) break;
    known_.insert(std::move(*column));
    rest.remove_prefix(end + 1);
  }
  return bytes.size() - rest.size();
}

void OverlapJournal::append(std::size_t target, const std::vector<double>& column) {
  std::string line = std::to_string(target);
  for (const double value : column) {
    line += ' ';
    pcrb::appendShortest(line, value);
  }
  file_ << line << '\n' << std::flush;
  if (!file_) throw pcrb::InvalidFile(path_, "cannot be written");
}

void OverlapJournal::remove() {
  file_.close();
  std::filesystem::remove(path_);
}

}  // namespace pcrb_tools
