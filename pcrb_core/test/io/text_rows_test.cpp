#include "pcrb_core/io/text_rows.hpp"

#include <gtest/gtest.h>

#include "pcrb_core/error.hpp"

namespace pcrb {
namespace {

using Fields = std::vector<std::string_view>;

TEST(LineReader, TakesLinesOfBothSystemsAndAnUnfinishedLast) {
  LineReader lines("a\r\n\nb\r\r\nlast", "file");
  std::string_view line;
  EXPECT_EQ(lines.lineNumber(), 0u);
  ASSERT_TRUE(lines.next(line));
  EXPECT_EQ(line, "a");
  ASSERT_TRUE(lines.next(line));
  EXPECT_EQ(line, "");
  ASSERT_TRUE(lines.next(line));
  EXPECT_EQ(line, "b\r");
  EXPECT_EQ(lines.rest(), "last");
  ASSERT_TRUE(lines.next(line));
  EXPECT_EQ(line, "last");
  EXPECT_EQ(lines.lineNumber(), 4u);
  EXPECT_FALSE(lines.next(line));
}

TEST(LineReader, AFinalNewlineStartsNoLine) {
  LineReader lines("a\n", "file");
  std::string_view line;
  EXPECT_TRUE(lines.next(line));
  EXPECT_FALSE(lines.next(line));
}

TEST(LineReader, FailureNamesFileAndLine) {
  LineReader lines("a\nb\n", "folder/file.txt");
  std::string_view line;
  lines.next(line);
  lines.next(line);
  try {
    lines.fail(inQuotes(line), "'c'");
    FAIL();
  } catch (const InvalidFile& error) {
    EXPECT_STREQ(error.what(), "folder/file.txt:2: found 'b', expected 'c'");
  }
}

TEST(TextRows, SplitsAtRunsOfBlanks) {
  Fields fields{"old"};
  splitAtBlanks(" a\t b  c ", fields);
  EXPECT_EQ(fields, (Fields{"a", "b", "c"}));
  splitAtBlanks(" \t", fields);
  EXPECT_EQ(fields, (Fields{}));
}

TEST(TextRows, SplitsAtSeparatorsKeepingEmptyFields) {
  Fields fields;
  splitAt(',', " a ,,b,", fields);
  EXPECT_EQ(fields, (Fields{"a", "", "b", ""}));
}

TEST(TextRows, QuotesShortenAndEscape) {
  EXPECT_EQ(inQuotes("a b"), "'a b'");
  EXPECT_EQ(inQuotes(std::string("\xff\0", 2)), "'\\xff\\x00'");
  EXPECT_EQ(inQuotes(std::string(41, 'x')), "'" + std::string(40, 'x') + "...'");
}

}  // namespace
}  // namespace pcrb
