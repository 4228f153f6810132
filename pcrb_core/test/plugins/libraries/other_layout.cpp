// A library that was compiled with another release's headers.

#include "pcrb_core/registration/registry.hpp"

namespace {

pcrb::RegistrationLayout formerLayout() {
  pcrb::RegistrationLayout layout = pcrb::kRegistrationLayout;
  layout[0] = pcrb::kRegistrationInterface - 1;
  return layout;
}

[[maybe_unused]] const bool registered = pcrb::registerMethod(
    "other_layout",
    [](pcrb::ParameterReader&) -> std::unique_ptr<pcrb::Registration> { return nullptr; },
    formerLayout());

}  // namespace
