#pragma once

#include <string>
#include <vector>

namespace gestell::fuzz
{

/// A reader of the program, fed with bytes as a file or an option of anybody might hold them.
struct Target
{
  std::string name;
  /// Reads them.  What the reader promises of its result is asked for: numbers that are finite, texts that read back.
  /// @throws std::invalid_argument where the bytes are refused, std::logic_error where a promise is broken
  void (*read)(const std::string &bytes);
};

/// All of them, by name.
const std::vector<Target> &targets();

/// @throws std::invalid_argument if there is none of that name
const Target &target(const std::string &name);

/**
 * Feeds a target: it returns, or refuses the bytes by std::invalid_argument with a message of the reader's own.
 *
 * @throws std::logic_error ("finding: ...") for any other exception, for a message that is empty or one of the
 *         standard library's ("stoi"), for a broken promise.
 */
void feed(const Target &target, const std::string &bytes);

/// A file of these bytes in a folder of this process; the name tells its kind.
/// @return its path; the next call with that name writes the file anew
std::string file_of(const std::string &name, const std::string &bytes);

/// @throws std::logic_error "finding: WHAT" if it does not hold
void promise(bool holds, const std::string &what);

// The targets, by what they read.
std::vector<Target> scene_targets();  ///< scenes, expressions, overrides, studies, cases
std::vector<Target> matrix_targets(); ///< matrices and nodes of other programs
std::vector<Target> model_targets();  ///< texts of meshes and geometry, before gmsh sees them
std::vector<Target> table_targets();  ///< tables and measured curves
std::vector<Target> kept_targets();   ///< what the program keeps for itself: frames, checkpoints, rows of studies

} // namespace gestell::fuzz
