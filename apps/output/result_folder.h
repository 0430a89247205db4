#pragma once

#include "apps/output/values/result.h"

#include <filesystem>
#include <string>
#include <vector>

namespace gestell::apps
{

/// Makes sure, before anything is computed, that results could be written into `folder`; leaves everything as it was.
/// @throws std::invalid_argument with path, reason and remedy.
void require_writable(const std::filesystem::path &folder);

/**
 * Makes `folder` ready for results: as require_writable(), then creates it with its parents and removes what an
 * earlier run of ours left there (nothing else), so that no old result survives beside a new one.
 *
 * @throws std::invalid_argument with path, reason and remedy.
 */
void prepare_folder(const std::filesystem::path &folder);

/**
 * Writes every file of docs/results.md that `result` has the values for: tables first, then the ParaView files, the
 * report, which tells what they could not show, and summary.json, whose presence says that the folder is complete.
 *
 * @return names of the files written, relative to the folder; summary.json last.
 * @throws std::runtime_error if a file cannot be written to its end (disk full).
 */
std::vector<std::string> write_results(const std::filesystem::path &folder, const Result &result);

/// Writes tables, charts and frame_modes.pvd of modes and frequency responses alone, into a folder whose other results
/// stay.
/// @throws std::runtime_error as write_results().
void write_modes(const std::filesystem::path &folder, const Result &result);

/// Whether a run ended before all of its results were in `folder`: there are files of a run, but no summary.json.
bool incomplete(const std::filesystem::path &folder);

std::string incomplete_words(const std::filesystem::path &folder); ///< a warning of such a folder

} // namespace gestell::apps
