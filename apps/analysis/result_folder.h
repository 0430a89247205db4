#pragma once

#include "apps/output/values/result.h"

#include <filesystem>
#include <string>
#include <vector>

namespace gestell::apps
{

/// Checks before the computation that files can be written into `folder`; changes nothing.
/// @throws std::invalid_argument with path, reason and remedy.
void require_writable(const std::filesystem::path &folder);

/**
 * Like require_writable(); also checks that no result would replace a file that is not ours, or an input.
 *
 * @param more    names that are written in addition to those of write_results(), see OwnFolder::require_free()
 * @param inputs  files that the command reads
 * @throws std::invalid_argument with the obstructing file and the remedy
 */
void require_room(const std::filesystem::path &folder, const std::vector<std::string> &more = {},
                  const std::vector<std::filesystem::path> &inputs = {});

/**
 * Prepares `folder` for results: creates it with its parents and removes results of an earlier run that are ours by its
 * list (OwnFolder), so that old and new results are never mixed.  Inputs and the checkpoint remain.
 *
 * A full disk is not an error here; write_results() reports it.
 *
 * @throws std::invalid_argument with path, reason and remedy, as require_room() does.
 */
void prepare_folder(const std::filesystem::path &folder, const std::vector<std::filesystem::path> &inputs = {});

/**
 * Writes every file of docs/reference/results.md for which `result` has values: history and tables first, then the
 * report and its charts, the ParaView files, and summary.json, for which disk space is reserved at the start.
 *
 * Files that cannot be written are skipped, a ParaView series as a whole, and listed in the warnings of summary.json;
 * all results are then written into a new temporary folder, if that is possible.
 *
 * @return names of the files written, relative to the folder; summary.json last.
 * @throws coupling::WriteFailure after writing all other files if one could not be written (disk full): with the file,
 * the reason, and the folder of the results.
 */
std::vector<std::string> write_results(const std::filesystem::path &folder, const Result &result);

/// Writes only tables, charts and frame_modes.pvd of modes and frequency responses; other results in the folder remain.
/// @throws coupling::WriteFailure if a file cannot be written
void write_modes(const std::filesystem::path &folder, const Result &result);

/// Whether a run ended before all of its results were in `folder`: it contains files of a run, but no summary.json.
bool incomplete(const std::filesystem::path &folder);

std::string incomplete_words(const std::filesystem::path &folder); ///< a warning about such a folder

} // namespace gestell::apps
