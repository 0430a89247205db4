#pragma once

#include "fem/geometry/cad_shape.h"

#include <STEPControl_Reader.hxx>

namespace gestell::fem
{

/**
 * Adds materials of parts, by name and density, to the labels of their solids.
 *
 * From the entities of the file, because XCAFDoc_MaterialTool of OpenCASCADE 7.6 ignores the prefix of a mass unit: it
 * returns 7.85 for 7.85 g/cm^3 and 0.00785 for 7850 kg/m^3.
 */
void read_step_materials(CadShape &shape, const STEPControl_Reader &reader);

} // namespace gestell::fem
