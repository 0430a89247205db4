#pragma once

#include <string>

namespace gestell::apps
{

/**
 * Makes standard input, output and error safe; to be called first.
 *
 * A closed stream is opened on the null device: otherwise an output file would get its number, and text would be
 * written into that file.  Writing to an output that was closed fails.  The reader of a pipe may end before the
 * program, which continues: results are more than the printed text.
 */
void secure_standard_streams();

/// Reason why the output was not completely written to standard output: a full disk, a closed output.  "" if it was, or
/// if the reader of a pipe ended early.
std::string standard_output_failure();

} // namespace gestell::apps
