#pragma once

#include <functional>

namespace gestell::coupling
{

/// Golden section for the largest f in [a, b], to 1e-9 of its width: 1e-18 of the height of a peak.
double highest(const std::function<long double(double)> &f, double a, double b);

} // namespace gestell::coupling
