// A library whose method has the name of one of the suite's own.

#include "pcrb_core/registration/registry.hpp"

namespace {

class AnotherIcp : public pcrb::Registration {
 public:
  explicit AnotherIcp(pcrb::ParameterReader&) {}

 protected:
  void prepareTarget(const pcrb::PointCloud&) override {}
  pcrb::RegistrationResult alignSource(const pcrb::PointCloud&, const pcrb::Transform&) override {
    return {};
  }
};

PCRB_REGISTER_METHOD("icp", AnotherIcp)

}  // namespace
