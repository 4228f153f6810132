#pragma once

#include <gtest/gtest.h>

#include <string>

namespace pcrb_test {

/// Claims that an action throws an `Exception` whose message holds a text.
template <typename Exception, typename Action>
void expectError(Action&& action, const std::string& text) {
  try {
    action();
    ADD_FAILURE() << "nothing was thrown, expected '" << text << "'";
  } catch (const Exception& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find(text), std::string::npos)
        << "found '" << message << "', expected '" << text << "'";
  }
}

}  // namespace pcrb_test

#define PCRB_EXPECT_ERROR(Exception, expression, text) \
  pcrb_test::expectError<Exception>([&] { (void)(expression); }, text)
