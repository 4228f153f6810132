#pragma once

#include <gtest/gtest.h>

#include <string>

namespace pcrb_test {

/// Claims that an action throws an `Exception` whose message holds these texts.
template <typename Exception, typename Action, typename... Texts>
void expectError(Action&& action, const Texts&... texts) {
  try {
    action();
    ADD_FAILURE() << "nothing was thrown";
  } catch (const Exception& error) {
    const std::string message = error.what();
    for (const std::string& text : {std::string(texts)...}) {
      EXPECT_NE(message.find(text), std::string::npos)
          << "found '" << message << "', expected '" << text << "'";
    }
  }
}

}  // namespace pcrb_test

#define PCRB_EXPECT_ERROR(Exception, expression, text) \
  pcrb_test::expectError<Exception>([&] { (void)(expression); }, text)
