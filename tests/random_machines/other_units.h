#pragma once

#include "tests/random_machines/judge.h"

namespace gestell::tests
{

/**
 * The machine in other units of length, mass and time, each 2^k times as large with an even k from -12 to 12 at random:
 * the motion must be the same, by bdf with a tolerance and by one more way.  Products with powers of two do not round,
 * so that only thresholds in SI units change a motion; it may differ by what rounding of its masses and starting values
 * makes of it, ten times, and 1e-10.
 */
Verdict judge_in_other_units(const RandomMachine &machine, const std::filesystem::path &folder);

} // namespace gestell::tests
