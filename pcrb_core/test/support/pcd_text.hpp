#pragma once

#include <string>

#include "pcrb_core/error.hpp"
#include "pcrb_core/io/pcd.hpp"

namespace pcrb_test {

/// Small PCD files, changed entry by entry.
struct PcdText {
  std::string fields = "x y z";
  std::string size = "4 4 4";
  std::string type = "F F F";
  std::string count = "1 1 1";
  std::string width = "2";
  std::string height = "1";
  std::string viewpoint = "0 0 0 1 0 0 0";
  std::string points = "2";
  std::string data = "ascii";
  std::string body = "1 2 3\n4 5 6\n";

  /// The header has 10 lines: line 11 is the first of the body.
  std::string text() const {
    return "VERSION 0.7\nFIELDS " + fields + "\nSIZE " + size + "\nTYPE " + type + "\nCOUNT " +
           count + "\nWIDTH " + width + "\nHEIGHT " + height + "\nVIEWPOINT " + viewpoint +
           "\nPOINTS " + points + "\nDATA " + data + "\n" + body;
  }
};

inline pcrb::DatasetCloud parsePcd(const std::string& text, int threads = 1) {
  return pcrb::parsePcd(text.data(), text.data() + text.size(), "a.pcd", {threads});
}

/// What the reader says about a file; "no error" if it takes it.
inline std::string pcdError(const std::string& text, int threads = 1) {
  try {
    parsePcd(text, threads);
  } catch (const pcrb::InvalidFile& error) {
    return error.what();
  }
  return "no error";
}

}  // namespace pcrb_test
