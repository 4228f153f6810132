#include <new>
#include <stdexcept>

#include "pcrb_core/registration/registry.hpp"

namespace {

// Throws what user code may throw: at the first target, and at each object's second source. An
// object that has thrown must not be used again.
class ThrowingMethod : public pcrb::Registration {
 public:
  explicit ThrowingMethod(pcrb::ParameterReader& /*reader*/) {}

 protected:
  void prepareTarget(const pcrb::PointCloud& /*target*/) override {
    requireWhole();
    static int targets = 0;
    has_thrown_ = targets++ == 0;
    if (has_thrown_) throw std::bad_alloc();
  }

  pcrb::RegistrationResult alignSource(const pcrb::PointCloud& /*source*/,
                                       const pcrb::Transform& /*guess*/) override {
    requireWhole();
    static int failures = 0;
    has_thrown_ = sources_++ == 1;
    if (has_thrown_ && failures++ == 0) throw std::runtime_error("a library's message");
    if (has_thrown_) throw failures;
    return {};
  }

 private:
  void requireWhole() const {
    if (has_thrown_) throw std::logic_error("used again");
  }

  int sources_ = 0;
  bool has_thrown_ = false;
};

PCRB_REGISTER_METHOD("throwing_method", ThrowingMethod)

}  // namespace
