#include "datasets/pose_rows.hpp"

#include "pcrb_core/io/number.hpp"

namespace pcrb {

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
