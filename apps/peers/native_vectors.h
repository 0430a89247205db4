#pragma once

#include <sundials/sundials_nvector.h>

namespace gestell::peers
{

/// Replaces the arithmetic of a serial vector, and of all that are cloned from it, by loops compiled like the rest of
/// this program.  Distributed binaries of SUNDIALS are built for any processor and take most of a step's time there.
void use_native_arithmetic(N_Vector x);

} // namespace gestell::peers
