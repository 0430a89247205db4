#pragma once

#include <stdexcept>

namespace gestell::apps
{

/// A parameter is given another value, and no value of the scene depends on it.
struct IdleParameter : std::invalid_argument
{
  using std::invalid_argument::invalid_argument;
};

} // namespace gestell::apps
