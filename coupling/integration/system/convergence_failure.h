#pragma once

#include <stdexcept>

namespace gestell::coupling
{

/// A numerical method failed: where, and by how much.
class ConvergenceFailure : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

} // namespace gestell::coupling
