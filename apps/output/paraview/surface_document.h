#pragma once

#include <string>

class vtkPolyData;

namespace gestell::apps
{

/**
 * A surface as the text of a .vtp file: XML, its arrays appended as they are in memory.
 *
 * vtkXMLPolyDataWriter writes the same; it also computes the range of each array, which readers do anyway, and takes
 * four times as long.
 */
std::string surface_document(vtkPolyData &surface);

} // namespace gestell::apps
