#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "pcrb_core/registration/parameters.hpp"
#include "pcrb_core/registration/registration.hpp"

namespace pcrb {

/// Makes a method; it reads all its parameters from the reader.
using RegistrationFactory = std::function<std::unique_ptr<Registration>(ParameterReader&)>;

/// What a library of methods and the suite must agree on: version of the interface, then sizes and
/// alignments of what passes between them. Processor flags (-march=native, -mavx512f) change none
/// of it, other flags may (-D_GLIBCXX_DEBUG), and so does another release.
using RegistrationLayout = std::array<std::uint32_t, 6>;
constexpr std::uint32_t kRegistrationInterface = 3;
constexpr RegistrationLayout kRegistrationLayout{
    kRegistrationInterface,      sizeof(Registration), sizeof(RegistrationResult),
    alignof(RegistrationResult), sizeof(PointCloud),   alignof(PointCloud)};

/// Makes a method known to makeRegistration. Two methods of one name are refused when one of that
/// name is asked for. Returns true, so that it can initialise a variable of namespace scope.
///
/// @param layout  as the caller's compiler sees it: leave the default.
bool registerMethod(const std::string& name, RegistrationFactory factory,
                    const RegistrationLayout& layout = kRegistrationLayout);

/// Loads a shared library with methods of a user's own.
///
/// @param path  of the library, or its bare name (`libmy_methods.so`) where the loader finds it.
/// @return      names of the methods that it registered, sorted; the same if it was loaded before.
/// @throws InvalidParameter  if it cannot be loaded, registers no method, one whose name is taken,
/// or was compiled for another layout of the interface.
std::vector<std::string> loadRegistrationLibrary(const std::string& path);

/// PCL's version that the suite's methods were compiled with, and the number type of its G-ICP and
/// NDT: `1.13.0, double`. Another one gives other last digits (docs/platforms.md).
std::string pclOfMethods();

}  // namespace pcrb

#define PCRB_DETAIL_JOIN_(a, b) a##b
#define PCRB_DETAIL_JOIN(a, b) PCRB_DETAIL_JOIN_(a, b)

/// The one line that makes a class known by a name: `PCRB_REGISTER_METHOD("mine", MyMethod)`, at
/// namespace scope in a .cpp file. The class derives from pcrb::Registration and is constructed
/// from a pcrb::ParameterReader&.
#define PCRB_REGISTER_METHOD(name, Class)                                              \
  [[maybe_unused]] static const bool PCRB_DETAIL_JOIN(pcrb_registered_, __COUNTER__) = \
      ::pcrb::registerMethod(name, [](::pcrb::ParameterReader& reader) {               \
        return std::unique_ptr<::pcrb::Registration>(std::make_unique<Class>(reader)); \
      });
