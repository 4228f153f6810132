// A library as authors of fast methods compile theirs: for newer processors than the suite, so that
// Eigen aligns its own objects to more bytes than the suite's Eigen does.

#include <Eigen/SVD>

#include "pcrb_core/registration/registry.hpp"

namespace {

// Undoes the guess's rotation and turns it back by way of matrices on the stack and on the heap.
class FastMethod : public pcrb::Registration {
 public:
  explicit FastMethod(pcrb::ParameterReader&) {}

 protected:
  void prepareTarget(const pcrb::PointCloud& target) override {
    points_ = Eigen::MatrixXd::Zero(4, static_cast<Eigen::Index>(target.size()));
  }

  pcrb::RegistrationResult alignSource(const pcrb::PointCloud&,
                                       const pcrb::Transform& guess) override {
    const Eigen::Isometry3d aligned = guess;
    const Eigen::Matrix4d product = aligned.matrix() * guess.inverse().matrix() * guess.matrix();
    Eigen::MatrixXd moved = product * points_;
    moved.conservativeResize(4, moved.cols() + 1);
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(product.topLeftCorner(3, 3),
                                                Eigen::ComputeThinU | Eigen::ComputeThinV);
    pcrb::RegistrationResult result;
    result.T_target_source.matrix() = product;
    result.T_target_source.linear() = svd.matrixU() * svd.matrixV().transpose();
    result.converged = true;
    result.iterations = EIGEN_MAX_ALIGN_BYTES;
    return result;
  }

 private:
  Eigen::MatrixXd points_;
};

PCRB_REGISTER_METHOD("fast_method", FastMethod)

}  // namespace
