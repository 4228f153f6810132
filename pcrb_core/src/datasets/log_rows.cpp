#include "datasets/log_rows.hpp"

#include <cmath>

#include "pcrb_core/io/number.hpp"

namespace pcrb {

bool parseNumbers(std::string_view line, Separator separator, std::vector<double>& numbers) {
  numbers.clear();
  const char* const end = line.data() + line.size();
  const char* at = skipBlanks(line.data(), end);
  while (at != end) {
    double value = 0.0;
    const char* const after = scanDouble(at, end, value);
    if (after == nullptr) return false;
    at = skipBlanks(after, end);
    const bool separated =
        separator == Separator::kBlanks ? at != after || at == end : at == end || *at == ',';
    if (!separated) return false;
    numbers.push_back(value);
    if (separator == Separator::kComma && at != end) at = skipBlanks(at + 1, end);
  }
  return true;
}

std::vector<double> requireNumbers(const LineReader& reader, std::string_view line,
                                   Separator separator, std::size_t count,
                                   const std::string& expected) {
  std::vector<double> numbers;
  numbers.reserve(count);
  if (!parseNumbers(line, separator, numbers)) reader.fail(inQuotes(line), expected);
  if (numbers.size() != count) {
    reader.fail(std::to_string(numbers.size()) + " numbers in " + inQuotes(line), expected);
  }
  for (const double number : numbers) {
    if (!std::isfinite(number)) reader.fail("a number that is not finite", expected);
  }
  return numbers;
}

Transform requireLogPose(const LineReader& reader, const Eigen::Matrix<double, 3, 4>& rows) {
  const Eigen::Matrix3d R = rows.leftCols<3>();
  const double deviation = (R.transpose() * R - Eigen::Matrix3d::Identity()).norm();
  if (!(deviation <= kLogRotationTolerance) || R.determinant() < 0.0) {
    reader.fail("a matrix with |R'R - I| = " + formatShortest(deviation) +
                    " and det R = " + formatShortest(R.determinant()),
                "a rotation (at most 1e-3, and 1)");
  }
  Transform T = Transform::Identity();
  T.linear() = R;
  T.translation() = rows.col(3);
  return T;
}

Transform requireLogPose4x4(const LineReader& reader, const double* numbers) {
  using Matrix = Eigen::Matrix<double, 4, 4, Eigen::RowMajor>;
  const Matrix matrix = Eigen::Map<const Matrix>(numbers);
  if (matrix.row(3) != Eigen::RowVector4d(0, 0, 0, 1)) {
    reader.fail("another last row of the 4 x 4 matrix", "0 0 0 1");
  }
  return requireLogPose(reader, matrix.topRows<3>());
}

}  // namespace pcrb
