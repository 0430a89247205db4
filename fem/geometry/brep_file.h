#pragma once

#include "fem/values/cad_source.h"

namespace gestell::fem
{

/**
 * Reads a BREP file once as far as its counts lead, which OpenCASCADE does not: where a count is wrong or an entry is
 * lost it goes on behind the end of the file for hours, or for ever.
 *
 * May die of a damaged file as OpenCASCADE does: to be called where gmsh reads.
 *
 * @throws std::invalid_argument with the line if the file ends before its entries do, or holds a word in place of a
 *         number; Standard_Failure by OpenCASCADE
 */
void check_brep_file(const CadSource &source);

} // namespace gestell::fem
