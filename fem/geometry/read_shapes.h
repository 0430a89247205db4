#pragma once

#include "fem/geometry/cad_shape.h"
#include "fem/values/cad_source.h"

#include <memory>

namespace gestell::fem
{

/// Reads a STEP file in metres, or in millimetres with source.unit > 0, with the names of its solids and faces, and the
/// layers and colours of single faces.
/// @throws std::runtime_error, Standard_Failure by OpenCASCADE; it may crash on a damaged file
std::shared_ptr<CadShape> read_step(const CadSource &source);

/**
 * Reads a BREP file from a stream that throws at the first missing or malformed number. Without this check, a wrong
 * count or a missing entry makes OpenCASCADE read past the end of the file for hours or without end.
 *
 * @throws std::invalid_argument if the file ends before its entries do, or, with the line, contains a word in place of
 *   a number; Standard_Failure by OpenCASCADE; it may crash on a damaged file
 */
std::shared_ptr<CadShape> read_brep(const CadSource &source);

} // namespace gestell::fem
