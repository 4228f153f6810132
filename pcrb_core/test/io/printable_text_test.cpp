#include "pcrb_core/io/printable_text.hpp"

#include <gtest/gtest.h>

namespace pcrb {
namespace {

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

}  // namespace
}  // namespace pcrb
