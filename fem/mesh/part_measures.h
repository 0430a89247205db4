#pragma once

#include "fem/values/cad_body.h"
#include "fem/values/cad_source.h"

namespace gestell::fem
{

/// The work of measure_part() (measure_body.h), in this process; gmsh is left finalised.
CadBody measures_of_part(const CadSource &source);

} // namespace gestell::fem
