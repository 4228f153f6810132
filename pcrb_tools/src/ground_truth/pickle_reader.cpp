#include "ground_truth/pickle_reader.hpp"

#include "pcrb_core/error.hpp"
#include "pcrb_core/io/byte_order.hpp"
#include "pcrb_core/io/number.hpp"
#include "pcrb_core/io/text.hpp"

namespace pcrb_tools {
namespace {

constexpr std::size_t kMostValues = 10'000'000;  // far beyond any file of that kind
constexpr const char* kHarmless = "a pickle of lists, texts and numbers alone";

}  // namespace

Pickled PickleReader::next() {
  stack_.clear();
  memo_.clear();
  while (true) {
    const auto opcode = static_cast<unsigned char>(take(1)[0]);
    if (opcode == '.') return pop();
    run(opcode);
  }
}

void PickleReader::refuse(const std::string& found, const std::string& expected) const {
  throw pcrb::InvalidFile(path_, 0, found + " at byte " + std::to_string(place_), expected);
}

std::string_view PickleReader::take(std::size_t count) {
  if (count > bytes_.size() - place_) refuse("the end of the file", "more of the pickle");
  const std::string_view taken = bytes_.substr(place_, count);
  place_ += count;
  return taken;
}

std::string_view PickleReader::takeLine() {
  const std::string_view line = take(bytes_.substr(place_).find('\n'));
  take(1);
  return line;
}

std::uint64_t PickleReader::unsignedOf(std::size_t size) {
  return pcrb::loadUnsigned(take(size).data(), size);
}

std::int64_t PickleReader::longOf(std::size_t size) {
  if (size == 0) return 0;
  if (size > 8) refuse("an integer of " + std::to_string(size) + " bytes", "8 at most");
  const auto unused = static_cast<unsigned>(64 - 8 * size);
  return static_cast<std::int64_t>(unsignedOf(size) << unused) >> unused;
}

double PickleReader::numberOfLine() {
  std::string_view line = takeLine();
  if (!line.empty() && line.back() == 'L') line.remove_suffix(1);  // a long integer
  const auto number = pcrb::parseDouble(line);
  if (!number) refuse(pcrb::inQuotes(line), "a number");
  return *number;
}

std::uint64_t PickleReader::memoKeyOfLine() {
  const auto key = pcrb::parseUnsigned(takeLine());
  if (!key) refuse("a key that is no number", kHarmless);
  return *key;
}

Pickled PickleReader::pop() {
  if (stack_.empty()) refuse("nothing on the stack", kHarmless);
  const Pickled top = stack_.back();
  stack_.pop_back();
  if (top.type == Pickled::Type::kMark) refuse("a mark", kHarmless);
  return top;
}

void PickleReader::push(const Pickled& value) {
  if (++values_ > kMostValues) refuse("too many values", kHarmless);
  stack_.push_back(value);
}

void PickleReader::pushNumber(double number) {
  Pickled value;
  value.type = Pickled::Type::kNumber;
  value.number = number;
  push(value);
}

void PickleReader::pushText(std::string_view text) {
  Pickled value;
  value.type = Pickled::Type::kText;
  value.text = text;
  push(value);
}

void PickleReader::pushList(std::vector<Pickled> items) {
  Pickled value;
  value.type = Pickled::Type::kList;
  value.list = lists_.size();
  lists_.push_back(std::move(items));
  push(value);
}

std::vector<Pickled> PickleReader::popItems(std::size_t count) {
  std::vector<Pickled> items(count);
  while (count-- > 0) items[count] = pop();
  return items;
}

std::vector<Pickled> PickleReader::popToMark() {
  auto begin = stack_.end();
  while (begin != stack_.begin() && (begin - 1)->type != Pickled::Type::kMark) --begin;
  if (begin == stack_.begin()) refuse("no mark", kHarmless);
  std::vector<Pickled> items(begin, stack_.end());
  stack_.erase(begin - 1, stack_.end());
  return items;
}

void PickleReader::append(const std::vector<Pickled>& items) {
  if (stack_.empty() || stack_.back().type != Pickled::Type::kList) {
    refuse("something added to no list", kHarmless);
  }
  auto& target = lists_[stack_.back().list];
  target.insert(target.end(), items.begin(), items.end());
}

void PickleReader::keep(std::uint64_t number) {
  if (stack_.empty()) refuse("nothing to remember", kHarmless);
  memo_[number] = stack_.back();
}

void PickleReader::recall(std::uint64_t number) {
  const auto known = memo_.find(number);
  if (known == memo_.end()) refuse("an object that was not remembered", kHarmless);
  push(known->second);
}

void PickleReader::run(unsigned char opcode) {
  switch (opcode) {
    case 0x80:  // PROTO
      return void(take(1));
    case 0x95:  // FRAME
      return void(take(8));
    case 'G':
      return pushNumber(pcrb::loadFloat<double>(take(8).data(), true));
    case 'J':
      return pushNumber(static_cast<std::int32_t>(unsignedOf(4)));
    case 'M':
      return pushNumber(static_cast<double>(unsignedOf(2)));
    case 'K':
      return pushNumber(static_cast<double>(unsignedOf(1)));
    case 0x8a:  // LONG1
      return pushNumber(static_cast<double>(longOf(unsignedOf(1))));
    case 'F':
    case 'I':
    case 'L':
      return pushNumber(numberOfLine());
    default:
      runOnTexts(opcode);
  }
}

void PickleReader::runOnTexts(unsigned char opcode) {
  switch (opcode) {
    case 'X':
    case 'T':
      return pushText(take(unsignedOf(4)));
    case 0x8c:  // SHORT_BINUNICODE
    case 'U':
      return pushText(take(unsignedOf(1)));
    case 'V':
    case 'S':
      return pushText(takeLine());
    default:
      runOnLists(opcode);
  }
}

void PickleReader::runOnLists(unsigned char opcode) {
  switch (opcode) {
    case '(':
      return push({});
    case ']':
    case ')':
      return pushList({});
    case 'l':
    case 't':
      return pushList(popToMark());
    case 0x85:  // TUPLE1
    case 0x86:
    case 0x87:
      return pushList(popItems(opcode - 0x84U));
    case 'e':
      return append(popToMark());
    case 'a':
      return append({pop()});
    default:
      runOnMemo(opcode);
  }
}

void PickleReader::runOnMemo(unsigned char opcode) {
  switch (opcode) {
    case 'p':
      return keep(memoKeyOfLine());
    case 'q':
      return keep(unsignedOf(1));
    case 'r':
      return keep(unsignedOf(4));
    case 0x94:  // MEMOIZE
      return keep(memo_.size());
    case 'g':
      return recall(memoKeyOfLine());
    case 'h':
      return recall(unsignedOf(1));
    case 'j':
      return recall(unsignedOf(4));
    default:
      refuseCode(opcode);
  }
}

/// The name of what a pickle would import says best what is wrong with it.
void PickleReader::refuseCode(unsigned char opcode) {
  std::string name;
  if (opcode == 'c' || opcode == 'i') {
    name = std::string(takeLine()) + ".";
    name += takeLine();
  } else if (opcode == 0x93) {  // STACK_GLOBAL
    const auto texts = popItems(2);
    name = std::string(texts[0].text) + "." + std::string(texts[1].text);
  }
  if (name.empty()) refuse("the opcode " + std::to_string(opcode), kHarmless);
  refuse("Python's " + pcrb::inQuotes(name) + ", which is not run,", kHarmless);
}

}  // namespace pcrb_tools
