#pragma once

#include <cmath>

namespace pcrb {

/// A sum in twice the precision of double: for large terms that cancel, and for long sums.
/// Source: Dekker, A floating-point technique for extending the available precision, 1971.
class DoubleDouble {
 public:
  void add(double value) {
    const double sum = high_ + value;
    const double added = sum - high_;
    low_ += (high_ - (sum - added)) + (value - added);
    high_ = sum;
  }

  void addProduct(double a, double b) {
    const double product = a * b;
    add(product);
    low_ += std::fma(a, b, -product);
  }

  /// The sum, rounded to double.
  double value() const { return high_ + low_; }

 private:
  double high_ = 0.0;
  double low_ = 0.0;
};

}  // namespace pcrb
