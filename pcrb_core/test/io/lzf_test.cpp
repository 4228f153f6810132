#include "io/lzf.hpp"

#include <gtest/gtest.h>

#include <string>

namespace pcrb {
namespace {

/// What the data decodes to, or "broken".
std::string decode(const std::string& input, std::size_t size) {
  std::string output(size, '?');
  return decodeLzf(input, output.data(), size) ? output : "broken";
}

TEST(Lzf, DecodesLiteralsAndCopies) {
  EXPECT_EQ(decode(std::string("\x02") + "abc", 3), "abc");
  // Three bytes again from a distance of three.
  EXPECT_EQ(decode(std::string("\x02") + "abc" + std::string("\x20\x02", 2), 6), "abcabc");
  EXPECT_EQ(decode("", 0), "");
}

TEST(Lzf, OverlappingCopiesRepeat) { EXPECT_EQ(decode(std::string("\0a\x60\0", 4), 6), "aaaaaa"); }

TEST(Lzf, LongCopiesTakeAnotherLengthByte) {
  EXPECT_EQ(decode(std::string("\0a\xe0\xff\0", 5), 265), std::string(265, 'a'));
}

TEST(Lzf, RejectsWhatReadsOrWritesOutside) {
  EXPECT_EQ(decode(std::string("\x02") + "ab", 3), "broken");      // literal cut off
  EXPECT_EQ(decode(std::string("\x02") + "abc", 2), "broken");     // literal too long
  EXPECT_EQ(decode(std::string("\0a\x20", 3), 4), "broken");       // copy cut off
  EXPECT_EQ(decode(std::string("\0a\xe0", 3), 10), "broken");      // length cut off
  EXPECT_EQ(decode(std::string("\0a\xe0\x01", 4), 11), "broken");  // distance cut off
  EXPECT_EQ(decode(std::string("\0a\x20\x01", 4), 4), "broken");   // from before the start
  EXPECT_EQ(decode(std::string("\0a\x20\0", 4), 3), "broken");     // copy too long
  EXPECT_EQ(decode(std::string("\0a", 2), 2), "broken");           // too little
}

}  // namespace
}  // namespace pcrb
