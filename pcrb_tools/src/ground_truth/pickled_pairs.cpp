#include "ground_truth/pickled_pairs.hpp"

#include <filesystem>
#include <string_view>

#include "ground_truth/pair_evaluation.hpp"
#include "ground_truth/pickle_reader.hpp"
#include "pcrb_core/error.hpp"
#include "pcrb_core/io/file_bytes.hpp"
#include "pcrb_core/io/number.hpp"

namespace pcrb_tools {
namespace {

constexpr std::string_view kSuffix = "_gt_check";
constexpr const char* kRows =
    "rows of 8 numbers: misalignment, translation, quaternion x y z w of each pair";

void addPickledRow(const PickleReader& reader, const Pickled& row, std::string& text) {
  if (row.type != Pickled::Type::kList) reader.refuse("a row that is no list", kRows);
  const auto& numbers = reader.listOf(row);
  if (numbers.size() == 6) {
    reader.refuse(
        "rows of 6 numbers (translations and angles of an earlier evaluation, without a "
        "misalignment)",
        std::string(kRows) +
            "; the published <sequence>_gt_check.dat of most sequences "
            "have them");
  }
  if (numbers.size() != 8) {
    reader.refuse("a row of " + std::to_string(numbers.size()) + " numbers", kRows);
  }
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (numbers[i].type != Pickled::Type::kNumber) reader.refuse("a row with no number", kRows);
    if (i > 0) text += ',';
    pcrb::appendShortest(text, numbers[i].number);
  }
  text += '\n';
}

}  // namespace

bool isPickled(const std::string& path) {
  return std::filesystem::path(path).extension() == ".dat";
}

std::string sequenceOfPickled(const std::string& path) {
  const std::string stem = std::filesystem::path(path).stem().string();
  return stem.substr(0, stem.find(kSuffix));
}

std::string readPickledPairs(const std::string& path) {
  const pcrb::FileBytes bytes(path);
  PickleReader reader(bytes.text(), path);
  reader.next();  // the command
  const Pickled rows = reader.next();
  if (rows.type != Pickled::Type::kList) reader.refuse("no list", kRows);
  if (!reader.atEnd()) reader.refuse("more behind the rows", "two pickles");
  std::string text = std::string(publishedPairHeader()) + "\n";
  for (const Pickled& row : reader.listOf(rows)) addPickledRow(reader, row, text);
  return text;
}

}  // namespace pcrb_tools
