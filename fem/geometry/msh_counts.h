#pragma once

#include <functional>
#include <string>

namespace gestell::fem
{

/**
 * Compares what a binary mesh file of gmsh (MSH 4.1) announces with the bytes that follow: entities, nodes and
 * elements, in all and block by block.  gmsh believes every number and asks for as much memory, or reads on behind the
 * end of the file.
 *
 * Other formats pass, and so does what this does not know: gmsh judges it.
 *
 * @param refuse  is told what is wrong, as the end of a sentence that begins with the file
 */
void check_msh_counts(const std::string &path, const std::function<void(const std::string &)> &refuse);

} // namespace gestell::fem
