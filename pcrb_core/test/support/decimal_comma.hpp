#pragma once

#include <clocale>
#include <locale>
#include <string>

namespace pcrb_test {

/// While it lives, C++ streams write and read a decimal comma, and so do C functions where the
/// machine has a German locale.
class DecimalComma {
 public:
  DecimalComma()
      : before_(std::setlocale(LC_ALL, nullptr)),
        streams_before_(std::locale::global(std::locale(std::locale::classic(), new Comma))) {
    std::setlocale(LC_ALL, "de_DE.UTF-8");
  }
  ~DecimalComma() {
    std::locale::global(streams_before_);
    std::setlocale(LC_ALL, before_.c_str());
  }
  DecimalComma(const DecimalComma&) = delete;
  DecimalComma& operator=(const DecimalComma&) = delete;

 private:
  class Comma : public std::numpunct<char> {
    char do_decimal_point() const override { return ','; }
    char do_thousands_sep() const override { return '.'; }
    std::string do_grouping() const override { return "\3"; }
  };

  std::string before_;
  std::locale streams_before_;
};

}  // namespace pcrb_test
