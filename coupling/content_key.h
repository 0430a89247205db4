#pragma once

#include "coupling/frame_service.h"

#include <string>
#include <vector>

namespace gestell::coupling
{

/**
 * Key of a reduced frame: SHA-256, in hexadecimal, over the bytes of the files it is made from, over every value of the
 * specification and of the options, and over the versions of program and file format.  Equal keys mean equal frames.
 *
 * Places (file:line for messages), the path of a file and the order of tables in a scene do not count; every number
 * counts with all its digits.  With a script of gmsh (.geo) count the files it names as text in Include, Merge and
 * ShapeFromFile, and those that these name; what it names and is not there counts by its name.
 *
 * @throws std::invalid_argument if a file cannot be read.
 */
std::string content_key(const fem::FrameSpecification &frame, const ReductionOptions &options);

/// The same for a frame that is given by matrices: its files and a text that says how they are read.
std::string content_key(const std::vector<std::string> &files, const std::string &text,
                        const ReductionOptions &options);

} // namespace gestell::coupling
