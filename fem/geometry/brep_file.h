#pragma once

#include "fem/values/cad_source.h"

namespace gestell::fem
{

/**
 * Reads a BREP file by OpenCASCADE from a stream that throws at the first word that is missing or no number: without,
 * it goes on behind the end of the file for hours, or for ever, where a count is wrong or an entry lost.
 *
 * May die of a damaged file as OpenCASCADE does: to be called where gmsh reads.
 *
 * @throws std::invalid_argument if the file ends before its entries do, or, with the line, holds a word in place of a
 *         number; Standard_Failure by OpenCASCADE
 */
void check_brep_file(const CadSource &source);

} // namespace gestell::fem
