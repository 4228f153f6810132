#include "pcrb_core/io/text.hpp"

#include <gtest/gtest.h>

#include "pcrb_core/error.hpp"
#include "pcrb_core/io/csv.hpp"
#include "support/expect_error.hpp"

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

TEST(TextRows, ReadsATextWithoutAnyLineEnd) {
  for (const std::string text : {"", "a", "ab", "a\r"}) {
    LineReader lines(text, "file.txt");
    std::string_view line;
    EXPECT_EQ(lines.next(line), !text.empty());
    EXPECT_FALSE(lines.next(line));
  }
}

TEST(TextRows, QuotesShortenAndEscape) {
  EXPECT_EQ(inQuotes("a b"), "'a b'");
  EXPECT_EQ(inQuotes(std::string("\xff\0", 2)), "'\\xff\\x00'");
  EXPECT_EQ(inQuotes(std::string(41, 'x')), "'" + std::string(40, 'x') + "...'");
}

using CsvRow = std::vector<std::string>;

std::vector<CsvRow> rowsOf(const std::string& text) {
  LineReader lines(text, "file.csv");
  std::vector<CsvRow> rows;
  CsvRow fields;
  while (nextCsvRow(lines, fields)) rows.push_back(fields);
  return rows;
}

TEST(Csv, ReadsBackWhateverFieldsItWrote) {
  const CsvRow fields{"",  "plain", "a, b", "says \"no\"", "\"", "two\nlines\n",
                      ",", "\"\"",  "ä",    " ",           " a", "b\t"};
  std::string line;
  for (const std::string& field : fields) {
    if (!line.empty()) line += ',';
    appendCsvField(line, field);
  }
  // The first field is empty.
  EXPECT_EQ(rowsOf("," + line + "\n" + "next"), (std::vector<CsvRow>{fields, {"next"}}));
}

TEST(Csv, QuotesOnlyWhatNeedsIt) {
  std::string line;
  appendCsvField(line, "a b");
  appendCsvField(line, "c,\"d\"");
  EXPECT_EQ(line, "a b\"c,\"\"d\"\"\"");
}

TEST(Csv, KeepsEmptyFieldsAndDropsBlanksAroundFields) {
  EXPECT_EQ(rowsOf(" a ,,\tb, \" c \" ,\r\n"), (std::vector<CsvRow>{{"a", "", "b", " c ", ""}}));
}

TEST(Csv, PassesOverBlankLinesBetweenRows) {
  EXPECT_EQ(rowsOf("a,b\n\n \t\r\nc,d\n\n"), (std::vector<CsvRow>{{"a", "b"}, {"c", "d"}}));
}

TEST(Csv, TakesAQuoteInsideAFieldAsItIs) {
  EXPECT_EQ(rowsOf("5\" wide,b"), (std::vector<CsvRow>{{"5\" wide", "b"}}));
}

TEST(Csv, RefusesAQuoteThatDoesNotEndAndTextBehindOne) {
  pcrb_test::expectError<InvalidFile>([] { rowsOf("a\nb,\"c\nd\n"); }, "file.csv:3",
                                      "no end of the quote that opens in line 2");
  pcrb_test::expectError<InvalidFile>([] { rowsOf("\"a\"b,c\n"); }, "file.csv:1", "'b'",
                                      "expected a comma");
}

const std::string kReplaced = "\xef\xbf\xbd";

TEST(PrintableText, KeepsCharactersOfAnyLengthAndLineEnds) {
  const std::string text = "a\tb\r\n \xc3\xa9 \xe2\x82\xac \xf0\x9f\x98\x80";
  EXPECT_EQ(printableText(text), text);
  EXPECT_EQ(printableText(""), "");
}

TEST(PrintableText, ReplacesBytesThatAreNoUtf8AndNothingBesideThem) {
  EXPECT_EQ(printableText("\xc9"
                          "ch\xc3"),
            kReplaced + "ch" + kReplaced);
  EXPECT_EQ(printableText("\xe2\x82x"), kReplaced + kReplaced + "x");
  EXPECT_EQ(printableText("\xc0\xaf"), kReplaced + kReplaced) << "an overlong form";
  EXPECT_EQ(printableText("\xed\xa0\x80"), kReplaced + kReplaced + kReplaced) << "half a pair";
}

TEST(PrintableText, ReplacesWhatXmlCannotHold) {
  EXPECT_EQ(printableText(std::string("a\0\x1b[1m\x7f", 7)),
            "a" + kReplaced + kReplaced + "[1m" + kReplaced);
  EXPECT_EQ(printableText("\xef\xbf\xbe\xef\xbf\xbf"), kReplaced + kReplaced);
}

TEST(RequireUtf8, RefusesWhatPrintableTextWouldChangeAndSaysWhy) {
  requireUtf8("/caf\xc3\xa9", "so it is");
  pcrb_test::expectError<InvalidParameter>(
      [] { requireUtf8("/caf\xe9\x1b", "so it is"); },
      "found `/caf" + kReplaced + kReplaced + "`, expected UTF-8: so it is");
}

}  // namespace
}  // namespace pcrb
