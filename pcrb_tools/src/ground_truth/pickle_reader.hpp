#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace pcrb_tools {

/// A text, a number, or a list of such; lists share what they hold.
struct Pickled {
  enum class Type { kText, kNumber, kList, kMark };
  Type type = Type::kMark;
  std::string_view text;  ///< as it stands in the file: escapes of protocol 0 are not resolved
  double number = 0.0;
  std::size_t list = 0;  ///< for listOf()
};

/// Reads Python pickles of all protocols (0 to 5) that hold lists, tuples, texts and numbers alone.
/// Nothing else can come of a pickle here: what would import, call or make anything is refused.
class PickleReader {
 public:
  /// @param bytes  one pickle behind the other; must outlive the reader.
  /// @param path   for messages.
  PickleReader(std::string_view bytes, std::string path) : bytes_(bytes), path_(std::move(path)) {}

  /// The next pickle's object. A tuple is a list.
  /// @throws pcrb::InvalidFile  with the byte where it is cut off or anything else than that.
  Pickled next();

  bool atEnd() const { return place_ == bytes_.size(); }
  const std::vector<Pickled>& listOf(const Pickled& value) const { return lists_[value.list]; }

  /// @throws pcrb::InvalidFile  always, for the byte that is read next.
  [[noreturn]] void refuse(const std::string& found, const std::string& expected) const;

 private:
  std::string_view take(std::size_t count);
  std::string_view takeLine();
  std::uint64_t unsignedOf(std::size_t size);
  std::int64_t longOf(std::size_t size);
  double numberOfLine();
  std::uint64_t memoKeyOfLine();

  Pickled pop();
  void push(const Pickled& value);
  void pushNumber(double number);
  void pushText(std::string_view text);
  void pushList(std::vector<Pickled> items);
  std::vector<Pickled> popItems(std::size_t count);
  std::vector<Pickled> popToMark();
  void append(const std::vector<Pickled>& items);
  void keep(std::uint64_t number);
  void recall(std::uint64_t number);

  void run(unsigned char opcode);
  void runOnTexts(unsigned char opcode);
  void runOnLists(unsigned char opcode);
  void runOnMemo(unsigned char opcode);
  [[noreturn]] void refuseCode(unsigned char opcode);

  std::string_view bytes_;
  std::string path_;
  std::size_t place_ = 0;
  std::size_t values_ = 0;
  std::vector<Pickled> stack_;
  std::map<std::uint64_t, Pickled> memo_;
  std::vector<std::vector<Pickled>> lists_;
};

}  // namespace pcrb_tools
