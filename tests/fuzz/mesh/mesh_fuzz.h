#pragma once

#include "tests/fuzz/mesh/mesh_targets.h"

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace gestell::fuzz
{

struct Finding
{
  std::uint64_t number;
  std::string   words;
};

/// How executions ended.
struct Tally
{
  std::uint64_t        executions = 0, taken = 0, refused = 0;
  std::uint64_t        died    = 0; ///< in gmsh: a message of the child's death
  std::uint64_t        limited = 0; ///< a message of the limits of time or memory
  std::uint64_t        stopped = 0; ///< while meshing
  std::vector<Finding> findings;

  std::string text() const;
};

struct FuzzOptions
{
  double        patience = 1.;    ///< [s] of processor time for one execution, before it is tried by itself
  std::string   keep;             ///< folder for files that died, were limited or found; empty: none
  std::uint64_t report_every = 0; ///< executions
};

/**
 * Executes the mutations [from, to) of a target.
 *
 * Many in one process, without the child that reads elsewhere; where that process dies or does not go on, the file is
 * read anew as the program reads it, which must refuse it by a message within its limits.
 */
Tally fuzz(const MeshTarget &target, std::uint64_t from, std::uint64_t to, const FuzzOptions &options = {});

/// Reads one file as the program does, in a process of its own; a finding if that dies or does not end.
/// @param seconds  limit of processor time for reading
Judgement judge_alone(const std::string &path, std::uint64_t number, int seconds = 1);

/// A file with these bytes in the folder.
std::string write_file(const MeshTarget &target, const std::string &bytes, const std::string &folder);

/// The file of a mutation, in the folder.
std::string write_mutation(const MeshTarget &target, std::uint64_t number, const std::string &folder);

} // namespace gestell::fuzz
