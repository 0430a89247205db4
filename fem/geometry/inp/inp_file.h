#pragma once

#include "fem/values/cad_source.h"

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace gestell::fem
{

/// The mesh of an input file of Abaqus or CalculiX; nodes and elements by their numbers in the file.
struct InpMesh
{
  struct Elements
  {
    std::string solid;     ///< element set of a *SOLID SECTION, else that of the *ELEMENT line, "" for none
    int         gmsh_type; ///< 4, 11: tetrahedra of 4, 10 nodes; 5, 17: hexahedra of 8, 20;
                           ///< 6, 18: prisms of 6, 15; 7: pyramids
    std::vector<std::size_t> numbers;
    std::vector<std::size_t> nodes; ///< in the order of gmsh
  };
  std::vector<std::size_t>                        numbers; ///< of the nodes
  std::vector<double>                             coordinates;
  std::vector<Elements>                           elements;
  std::map<std::string, std::vector<std::size_t>> node_sets;
  std::map<std::string, std::vector<std::vector<std::size_t>>>
                           faces; ///< *SURFACE, and sets of surface elements: corners
  std::vector<std::string> notes; ///< ignored contents
};

/**
 * Names are in upper case, since Abaqus names are case-insensitive.
 *
 * Reads *NODE, *ELEMENT, *NSET, *ELSET, *SURFACE, *SOLID SECTION (for the names of solids), and the files named by
 * *INCLUDE and INPUT= (keywords or data lines, inserted at this position); constraints between nodes and all other
 * keywords, such as materials and steps, are ignored with a note.  Elements: C3D4, C3D10, C3D8, C3D20, C3D6, C3D15 and
 * their variants (C3D10M, C3D8R, ...).  Middle nodes are assigned to the edges they are on.  Triangles and
 * quadrilaterals without a section, as meshers write them, only name surfaces; trusses without a section are ignored.
 * Parts and instances are supported if there is only one, without a displacement.
 *
 * @throws std::invalid_argument with file and line for unreadable input, other elements, elements with missing nodes,
 *         duplicate nodes or elements, middle nodes that are not on an edge, and for keywords that define the mesh in
 *         an unsupported way: generated nodes and elements (*NGEN, *NFILL, *NCOPY, *NMAP, *ELGEN, *ELCOPY, *IMPORT),
 *         coordinates in other systems (*SYSTEM, *NODE with SYSTEM=C or S), *IMPERFECTION, sets of nodes by elements,
 *         combined surfaces.
 */
InpMesh read_inp(const CadSource &source);

} // namespace gestell::fem
