#include "pcrb_core/io/csv.hpp"

#include <gtest/gtest.h>

#include "pcrb_core/error.hpp"
#include "support/expect_error.hpp"

namespace pcrb {
namespace {

using Fields = std::vector<std::string>;

std::vector<Fields> rowsOf(const std::string& text) {
  LineReader lines(text, "file.csv");
  std::vector<Fields> rows;
  Fields fields;
  while (nextCsvRow(lines, fields)) rows.push_back(fields);
  return rows;
}

TEST(Csv, ReadsBackWhateverFieldsItWrote) {
  const Fields fields{"", "plain", "a, b", "says \"no\"", "\"", "two\nlines\n", ",", "\"\"", "ä"};
  std::string line;
  for (const std::string& field : fields) {
    if (!line.empty()) line += ',';
    appendCsvField(line, field);
  }
  // The first field is empty.
  EXPECT_EQ(rowsOf("," + line + "\n" + "next"), (std::vector<Fields>{fields, {"next"}}));
}

TEST(Csv, QuotesOnlyWhatNeedsIt) {
  std::string line;
  appendCsvField(line, "a b");
  appendCsvField(line, "c,\"d\"");
  EXPECT_EQ(line, "a b\"c,\"\"d\"\"\"");
}

TEST(Csv, KeepsEmptyFieldsAndDropsBlanksAroundFields) {
  EXPECT_EQ(rowsOf(" a ,,\tb, \" c \" ,\r\n\n"),
            (std::vector<Fields>{{"a", "", "b", " c ", ""}, {""}}));
}

TEST(Csv, TakesAQuoteInsideAFieldAsItIs) {
  EXPECT_EQ(rowsOf("5\" wide,b"), (std::vector<Fields>{{"5\" wide", "b"}}));
}

TEST(Csv, RefusesAQuoteThatDoesNotEndAndTextBehindOne) {
  pcrb_test::expectError<InvalidFile>([] { rowsOf("a\nb,\"c\nd\n"); }, "file.csv:3",
                                      "no end of the quote that opens in line 2");
  pcrb_test::expectError<InvalidFile>([] { rowsOf("\"a\"b,c\n"); }, "file.csv:1", "'b'",
                                      "expected a comma");
}

}  // namespace
}  // namespace pcrb
