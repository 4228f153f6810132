// Libraries that are refused: test/CMakeLists.txt compiles one for each of these definitions.

#include "pcrb_core/registration/registry.hpp"

namespace {

class UselessMethod : public pcrb::Registration {
 public:
  explicit UselessMethod(pcrb::ParameterReader&) {}

 protected:
  void prepareTarget(const pcrb::PointCloud&) override {}
  pcrb::RegistrationResult alignSource(const pcrb::PointCloud&, const pcrb::Transform&) override {
    return {};
  }
};

#ifdef PCRB_TEST_LIBRARY_TAKEN_NAME
// A method that has the name of one of the suite's own.
PCRB_REGISTER_METHOD("icp", UselessMethod)
#endif

#ifdef PCRB_TEST_LIBRARY_OTHER_LAYOUT
// A method that was compiled with another release's headers.
pcrb::RegistrationLayout formerLayout() {
  pcrb::RegistrationLayout layout = pcrb::kRegistrationLayout;
  layout[0] = pcrb::kRegistrationInterface - 1;
  return layout;
}

[[maybe_unused]] const bool registered = pcrb::registerMethod(
    "other_layout",
    [](pcrb::ParameterReader& reader) -> std::unique_ptr<pcrb::Registration> {
      return std::make_unique<UselessMethod>(reader);
    },
    formerLayout());
#endif

// PCRB_TEST_LIBRARY_NO_METHOD: the line that registers the method was forgotten.

}  // namespace
