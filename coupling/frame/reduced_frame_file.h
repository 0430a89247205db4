#pragma once

#include "coupling/frame/frame_recipe.h"
#include "coupling/frame/reduced_frame.h"

#include <string>

namespace gestell::coupling
{

/// Origin of a reduced frame, stored with it; every part may be empty.
struct FrameOrigin
{
  Recipe      recipe;   ///< its inputs, which determine its key
  std::string scene;    ///< file of the scene that first requested it
  std::string source;   ///< CAD file or matrix; for people
  double      cpu = 0.; ///< [s] CPU time of its reduction, written for the cache only; 0: unknown
};

/**
 * Writes a reduced frame as HDF5: matrices as datasets in column-major order (dimensions reversed, as HDF5 counts rows
 * first), one group per interface and output, and its origin.  The first 512 bytes contain the format version and a
 * checksum of the whole file as text (checksummed_file.h).  The file is written atomically (temporary file, then
 * rename), so that several processes may write the same one. Equal frames give equal files.
 *
 * @throws std::runtime_error if the folder cannot be created or the file not be written.
 * @throws std::invalid_argument for a frame that is not modal.
 */
void write_reduced_frame(const std::string &file, const ReducedFrame &frame, const FrameOrigin &origin = {});

/// Reads a file of write_reduced_frame() exactly.  A file that this process has not yet read is first read in a forked
/// child (tried_file.h), because it may be forged.  read_stored_frame() uses no child: it is for our own files.
/// @throws std::invalid_argument if the file is missing, damaged, of another version or not a reduced frame.
ReducedFrame read_reduced_frame(const std::string &file);

/// A reduced frame with the data of its file.
struct StoredFrame
{
  FrameOrigin  origin;
  ReducedFrame frame;
};

/// The same with its origin.
/// @throws std::runtime_error with the defect of the file.
StoredFrame read_stored_frame(const std::string &file);

/// Title of the files of condensed parts (coupling/reduction/parts), which are in the cache beside those of frames;
/// they have the data of a FrameSummary, too.
constexpr const char *title_of_parts = "Gestell part of a frame 1"; // raise the number with the format

/// Data of a frame that are available without reading the whole file.
struct FrameSummary
{
  FrameOrigin origin;
  int         n_full = 0, n_interface = 0, n_modes = 0;
  bool        is_part = false; ///< a condensed part of a frame, not a reduced frame
};

/// Reads only header, origin and sizes: a few kilobytes of a file of any size.  Damage elsewhere is not detected;
/// because the checksum is not verified, a forked child reads them first.
/// @throws std::invalid_argument if GESTELL_READING_SECONDS is not a number
/// @throws std::runtime_error with the defect of the file.
FrameSummary read_frame_summary(const std::string &file);

} // namespace gestell::coupling
