#pragma once

#include "apps/output/values/result.h"

#include <filesystem>
#include <string>
#include <vector>

namespace gestell::apps
{

/// Makes sure, before anything is computed, that files could be written into `folder`; leaves everything as it was.
/// @throws std::invalid_argument with path, reason and remedy.
void require_writable(const std::filesystem::path &folder);

/**
 * As require_writable(); and that no result takes the place of a file that is not ours, or that the command reads.
 *
 * @param more    names that are written beside those of write_results(), see OwnFolder::require_free()
 * @param inputs  files that the command reads
 * @throws std::invalid_argument with the file in the way and the remedy
 */
void require_room(const std::filesystem::path &folder, const std::vector<std::string> &more = {},
                  const std::vector<std::filesystem::path> &inputs = {});

/**
 * Makes `folder` ready for results: creates it with its parents and removes results of an earlier run that its list
 * says are ours (OwnFolder), so that no old result survives beside a new one.  Inputs and the checkpoint stay.
 *
 * A full disk is no error here: what cannot be written is told by write_results().
 *
 * @throws std::invalid_argument with path, reason and remedy, as require_room().
 */
void prepare_folder(const std::filesystem::path &folder, const std::vector<std::filesystem::path> &inputs = {});

/**
 * Writes every file of docs/results.md that `result` has the values for: history and tables first, then the report and
 * its charts, the ParaView files, and summary.json, whose place on the disk is taken first.
 *
 * What cannot be written is left out and told among the warnings of summary.json, a series of ParaView as a whole; all
 * results then go into a new folder for temporary files, if they can.
 *
 * @return names of the files written, relative to the folder; summary.json last.
 * @throws coupling::WriteFailure if a file could not be written (disk full), when all others are: with the file, the
 * reason, and where the results are.
 */
std::vector<std::string> write_results(const std::filesystem::path &folder, const Result &result);

/// Writes tables, charts and frame_modes.pvd of modes and frequency responses alone, into a folder whose other results
/// stay.
/// @throws coupling::WriteFailure if a file cannot be written
void write_modes(const std::filesystem::path &folder, const Result &result);

/// Whether a run ended before all of its results were in `folder`: there are files of a run, but no summary.json.
bool incomplete(const std::filesystem::path &folder);

std::string incomplete_words(const std::filesystem::path &folder); ///< a warning of such a folder

} // namespace gestell::apps
