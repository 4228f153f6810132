#pragma once

#include <nanoflann.hpp>

// What differs between the releases of nanoflann.

namespace pcrb {

#if NANOFLANN_VERSION >= 0x150
using NanoflannParameters = nanoflann::SearchParameters;
#else
using NanoflannParameters = nanoflann::SearchParams;
#endif

/// Builds a tree whose constructor has not done so; since 1.4 it does.
template <typename Tree>
void buildNanoflann([[maybe_unused]] Tree& tree) {
#if NANOFLANN_VERSION < 0x140
  tree.buildIndex();
#endif
}

}  // namespace pcrb
