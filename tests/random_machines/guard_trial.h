#pragma once

#include "tests/random_machines/judge.h"
#include "tests/random_machines/trial.h"

namespace gestell::tests
{

/**
 * The word of the stability guard on a linear machine without loads, put to the test by random methods with random
 * steps: what it refuses grows when it is forced, what it lets pass does not, and the step that it offers is let pass
 * and does not grow.
 */
std::vector<Finding> guard_findings(const RandomMachine &machine, const Trial &trial, double &cpu_s);

} // namespace gestell::tests
