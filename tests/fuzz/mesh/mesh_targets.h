#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace gestell::fuzz
{

/// A kind of files that gmsh and the readers of meshes are fed with.
struct MeshTarget
{
  std::string              name;      ///< "msh_binary"
  std::string              extension; ///< ".msh"
  std::vector<std::string> seeds;     ///< sound files, small
};

/// Seeds are drawn with gmsh in a folder for temporary files.
const std::vector<MeshTarget> &mesh_targets();

/// @throws std::invalid_argument if there is none of that name
const MeshTarget &mesh_target(const std::string &name);

/// Names of them all.
std::vector<std::string> mesh_target_names();

enum class Outcome : char
{
  taken   = 't', ///< with a result that is sound
  refused = 'r', ///< by a message of the reader's own
  long_   = 'l', ///< gmsh meshed for a long time, and was stopped
  memory  = 'm', ///< there was none left: to be read alone, which tells it
  finding = 'F'
};

struct Judgement
{
  Outcome     outcome;
  std::string words; ///< the message, or what was found
};

/**
 * Reads a file through the doors of fem (make_mesh, inspect_geometry, measure_part) as its number says: of meshes and
 * parts all, of geometry a mesh of few cells or a look alone.
 *
 * Found is: another exception than std::invalid_argument, a message without the name of the file, a mesh with a point
 * that is not finite, with a cell that is flat or turned inside out, or with a part without volume.
 */
Judgement judge(const std::string &path, std::uint64_t number);

} // namespace gestell::fuzz
