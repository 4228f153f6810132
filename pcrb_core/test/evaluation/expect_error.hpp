#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace pcrb_test {

/// Expects an exception of a type whose message has all these parts.
template <typename ErrorType, typename Call>
void expectError(const Call& call, const std::vector<std::string>& parts) {
  try {
    call();
    ADD_FAILURE() << "nothing was thrown";
  } catch (const ErrorType& error) {
    for (const std::string& part : parts) {
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos)
          << "`" << part << "` is not in: " << error.what();
    }
  }
}

}  // namespace pcrb_test
