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

/// Compiles a hot function for several instruction sets and picks one when the program starts.
///
/// The instruction set does not change a result (fixed order of summation, no fused multiply-add),
/// only the time that it takes. Not with sanitizers, whose run-time is not up when the pick is
/// made.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define PCRB_HAS_CLONES
#define PCRB_CLONES_AVX2 __attribute__((target_clones("avx2", "default")))
#if __GNUC__ >= 12
#define PCRB_CLONES __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else  // which do not know the levels of x86-64
#define PCRB_CLONES __attribute__((target_clones("arch=skylake-avx512", "avx2", "default")))
#endif
#else
#define PCRB_CLONES_AVX2
#define PCRB_CLONES
#endif
