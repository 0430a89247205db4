#pragma once

#include <string>

namespace gestell::apps
{

/**
 * Makes standard input, output and error safe, first of all.
 *
 * One that is closed is opened on nothing: a file that is written would get its number, and the answer would be written
 * into it.  Writing to an output that was closed fails.  Who reads a pipe may end before the program does, which goes
 * on then: results are more than what is printed of them.
 */
void secure_standard_streams();

/// Why not all of the answer could be written to standard output: a full disk, a closed output.  "" if it was, or if
/// its reader did not want more.
std::string standard_output_failure();

} // namespace gestell::apps
