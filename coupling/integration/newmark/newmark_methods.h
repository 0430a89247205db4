#pragma once

#include "coupling/integration/integration_method.h"

namespace gestell::coupling
{

const IntegrationMethod &newmark_method();            ///< Newmark 1959
const IntegrationMethod &hht_method();                ///< Hilber, Hughes and Taylor 1977
const IntegrationMethod &generalised_alpha_method();  ///< Chung and Hulbert 1993
const IntegrationMethod &central_difference_method(); ///< Newmark's formulas with beta = 0, gamma = 1/2

} // namespace gestell::coupling
