#pragma once

#include <string>

namespace gestell::fem
{

/**
 * Compares the counts of a binary mesh file of gmsh (MSH 4.1) with the bytes that follow: entities, nodes and elements,
 * in total and per block, and the sums of the blocks. gmsh trusts every count: it allocates that memory, reads past the
 * end of the file, or writes past its memory.
 *
 * @return the defect, as the end of a sentence that begins with the file; "": none, or the file has another format or
 * unknown contents, left to gmsh
 */
std::string defect_of_counts(const std::string &path);

} // namespace gestell::fem
