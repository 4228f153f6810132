#include "pcrb_core/registration/registry.hpp"

namespace {

// Puts the source's centroid on the target's, and `lift` m higher.
class MyMethod : public pcrb::Registration {
 public:
  explicit MyMethod(pcrb::ParameterReader& reader)
      : lift_(reader.number("lift", 0.0, 0.0, 10.0)) {}  // default, least, most

 protected:
  void prepareTarget(const pcrb::PointCloud& target) override {
    target_centroid_ = pcrb::centroid(target);
  }

  pcrb::RegistrationResult alignSource(const pcrb::PointCloud& source,
                                       const pcrb::Transform& guess) override {
    pcrb::RegistrationResult result;
    result.T_target_source = guess;
    result.T_target_source.pretranslate(target_centroid_ - guess * pcrb::centroid(source) +
                                        lift_ * Eigen::Vector3d::UnitZ());
    result.converged = true;
    result.iterations = 1;
    return result;
  }

 private:
  double lift_;
  Eigen::Vector3d target_centroid_ = Eigen::Vector3d::Zero();
};

PCRB_REGISTER_METHOD("my_method", MyMethod)

}  // namespace
