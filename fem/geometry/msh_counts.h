#pragma once

#include <string>

namespace gestell::fem
{

/**
 * Compares what a binary mesh file of gmsh (MSH 4.1) announces with the bytes that follow: entities, nodes and
 * elements, in all and block by block, and the sums of the blocks with what they are to be.  gmsh believes every
 * number: it takes as much memory, reads on behind the end of the file, or writes behind the memory it took.
 *
 * @return what is wrong, as the end of a sentence that begins with the file; "": nothing, or the file is in another
 * format or holds what this does not know, of which gmsh is the judge
 */
std::string defect_of_counts(const std::string &path);

} // namespace gestell::fem
