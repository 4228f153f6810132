#include "pcrb_core/registration/registry.hpp"

namespace pcrb {
namespace {

/// Replies the initial guess: what every method has to be better than.
class DoNothing : public Registration {
 public:
  explicit DoNothing(ParameterReader& reader) { reader.threads(); }

 protected:
  void prepareTarget(const PointCloud& /*target*/) override {}

  RegistrationResult alignSource(const PointCloud& /*source*/, const Transform& guess) override {
    RegistrationResult result;
    result.T_target_source = guess;
    result.converged = true;
    return result;
  }
};

PCRB_REGISTER_METHOD("do_nothing", DoNothing)

}  // namespace
}  // namespace pcrb
