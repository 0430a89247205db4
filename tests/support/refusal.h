#pragma once

#include "tests/support/test.h"

namespace gestell::tests
{

/// What a call says when it refuses; "" if it does not.
template <typename Exception = std::invalid_argument, typename Call>
std::string refusal(Call &&call)
{
  try
  {
    call();
  }
  catch (const Exception &error)
  {
    return error.what();
  }
  return "";
}

/// A call refuses with these words among others.
template <typename Exception = std::invalid_argument, typename Call>
void expect_refusal(Call &&call, const std::string &words)
{
  EXPECT_THAT(refusal<Exception>(call), ::testing::HasSubstr(words));
}

} // namespace gestell::tests
