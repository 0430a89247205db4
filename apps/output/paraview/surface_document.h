#pragma once

#include <map>
#include <string>

class vtkPolyData;

namespace gestell::apps
{

/// Arrays of a surface that are the same in all its documents, compressed once.
using StillArrays = std::map<std::string, std::string>;

/**
 * A surface as the text of a .vtp file: XML, its arrays appended and compressed.
 *
 * vtkXMLPolyDataWriter writes the same; it also computes the range of each array, which readers do anyway, compresses
 * points and cells of each document anew, and takes several times as long.
 *
 * @param still  points and cells of earlier documents of this surface
 */
std::string surface_document(vtkPolyData &surface, StillArrays &still);

} // namespace gestell::apps
