#include "ground_truth/pickled_pairs.hpp"

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <map>
#include <optional>
#include <string_view>
#include <vector>

#include "ground_truth/pair_evaluation.hpp"
#include "pcrb_core/error.hpp"
#include "pcrb_core/io/file_bytes.hpp"
#include "pcrb_core/io/number.hpp"

namespace pcrb_tools {
namespace {

constexpr std::string_view kSuffix = "_gt_check";
constexpr std::size_t kMostValues = 10'000'000;  // far beyond any file of that kind

/// A text, a number, or a list of such; lists share what they hold.
struct Pickled {
  enum class Type { kText, kNumber, kList, kMark };
  Type type = Type::kMark;
  std::string_view text;
  double number = 0.0;
  std::size_t list = 0;  ///< position in the reader's lists
};

/// A stack machine for the few opcodes that lists of texts and numbers need, of protocols 2 to 5.
class PickleReader {
 public:
  PickleReader(std::string_view bytes, std::string path) : bytes_(bytes), path_(std::move(path)) {}

  /// The next pickle's object.
  Pickled next() {
    stack_.clear();
    memo_.clear();
    while (true) {
      const auto opcode = static_cast<unsigned char>(take(1)[0]);
      if (opcode == '.') return pop();
      run(opcode);
    }
  }

  bool atEnd() const { return place_ == bytes_.size(); }
  const std::vector<Pickled>& listOf(const Pickled& value) const { return lists_[value.list]; }

  [[noreturn]] void refuse(const std::string& found, const std::string& expected) const {
    throw pcrb::InvalidFile(path_, 0, found + " at byte " + std::to_string(place_), expected);
  }

 private:
  static constexpr const char* kExpected = "a pickle of lists, texts and numbers alone";

  std::string_view take(std::size_t count) {
    if (count > bytes_.size() - place_) refuse("the end of the file", "more of the pickle");
    const std::string_view taken = bytes_.substr(place_, count);
    place_ += count;
    return taken;
  }

  std::uint64_t unsignedOf(std::size_t size) {
    std::uint64_t value = 0;
    const std::string_view bytes = take(size);
    for (std::size_t i = size; i-- > 0;) {
      value = value << 8U | static_cast<unsigned char>(bytes[i]);
    }
    return value;
  }

  Pickled pop() {
    if (stack_.empty()) refuse("nothing on the stack", kExpected);
    const Pickled top = stack_.back();
    stack_.pop_back();
    if (top.type == Pickled::Type::kMark) refuse("a mark", kExpected);
    return top;
  }

  void pushNumber(double number) {
    Pickled value;
    value.type = Pickled::Type::kNumber;
    value.number = number;
    push(value);
  }

  void pushText(std::size_t size) {
    Pickled value;
    value.type = Pickled::Type::kText;
    value.text = take(size);
    push(value);
  }

  void pushList() {
    Pickled value;
    value.type = Pickled::Type::kList;
    value.list = lists_.size();
    lists_.emplace_back();
    push(value);
  }

  void push(const Pickled& value) {
    if (++values_ > kMostValues) refuse("too many values", kExpected);
    stack_.push_back(value);
  }

  void keep(std::uint64_t number) {
    if (stack_.empty()) refuse("nothing to remember", kExpected);
    memo_[number] = stack_.back();
  }

  void recall(std::uint64_t number) {
    const auto known = memo_.find(number);
    if (known == memo_.end()) refuse("an object that was not remembered", kExpected);
    push(known->second);
  }

  /// A big-endian double.
  double real() {
    const std::string_view bytes = take(8);
    std::uint64_t bits = 0;
    for (const char c : bytes) bits = bits << 8U | static_cast<unsigned char>(c);
    double value = 0.0;
    std::memcpy(&value, &bits, sizeof value);
    return value;
  }

  void appendTo(const Pickled& list, const std::vector<Pickled>& items) {
    if (list.type != Pickled::Type::kList) refuse("something added to no list", kExpected);
    auto& target = lists_[list.list];
    target.insert(target.end(), items.begin(), items.end());
  }

  void appendSinceMark() {
    auto begin = stack_.end();
    while (begin != stack_.begin() && (begin - 1)->type != Pickled::Type::kMark) --begin;
    if (begin - stack_.begin() < 2) refuse("no list before a mark", kExpected);
    const std::vector<Pickled> items(begin, stack_.end());
    stack_.erase(begin - 1, stack_.end());
    appendTo(stack_.back(), items);
  }

  void run(unsigned char opcode) {
    switch (opcode) {
      case 0x80:  // PROTO
        return void(take(1));
      case 0x95:  // FRAME
        return void(take(8));
      case '(':
        return push({});
      case ']':
        return pushList();
      case 'X':
        return pushText(unsignedOf(4));
      case 0x8c:  // SHORT_BINUNICODE
        return pushText(unsignedOf(1));
      case 'G':
        return pushNumber(real());
      case 'J':
        return pushNumber(static_cast<std::int32_t>(unsignedOf(4)));
      case 'M':
        return pushNumber(static_cast<double>(unsignedOf(2)));
      case 'K':
        return pushNumber(static_cast<double>(unsignedOf(1)));
      default:
        runOnMemoAndLists(opcode);
    }
  }

  void runOnMemoAndLists(unsigned char opcode) {
    switch (opcode) {
      case 'q':
        return keep(unsignedOf(1));
      case 'r':
        return keep(unsignedOf(4));
      case 0x94:  // MEMOIZE
        return keep(memo_.size());
      case 'h':
        return recall(unsignedOf(1));
      case 'j':
        return recall(unsignedOf(4));
      case 'e':
        return appendSinceMark();
      case 'a': {
        const Pickled item = pop();
        if (stack_.empty()) refuse("no list", kExpected);
        return appendTo(stack_.back(), {item});
      }
      default:
        refuse("the opcode " + std::to_string(opcode), kExpected);
    }
  }

  std::string_view bytes_;
  std::string path_;
  std::size_t place_ = 0;
  std::size_t values_ = 0;
  std::vector<Pickled> stack_;
  std::map<std::uint64_t, Pickled> memo_;
  std::vector<std::vector<Pickled>> lists_;
};

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
