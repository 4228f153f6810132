#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>

namespace pcrb_test {

/// Folder of the shared real data: $PCRB_SHARED_DATA, else beside the checkout; empty where absent.
inline std::string sharedData() {
  const char* variable = std::getenv("PCRB_SHARED_DATA");
  const std::string folder = variable != nullptr ? variable : PCRB_SHARED_DATA_DEFAULT;
  return std::filesystem::is_directory(folder) ? folder : std::string();
}

}  // namespace pcrb_test

/// Skips a test, saying so, on a machine without the shared data.
#define PCRB_REQUIRE_SHARED_DATA() \
  if (pcrb_test::sharedData().empty()) GTEST_SKIP() << "no shared data beside the checkout"
