#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace gestell::fem
{

/// Completeness of a STEP file (ISO 10303-21) by its text, which gmsh and OpenCASCADE do not check.
struct StepText
{
  std::size_t   n_entities    = 0;
  std::size_t   n_missing     = 0;    ///< references to missing entities
  std::uint64_t first_missing = 0;    ///< number of such an entity
  std::uint64_t named_by      = 0;    ///< number of the entity that references it
  std::string   no_number;            ///< the first invalid number, such as NaN; "" for none
  std::uint64_t no_number_in = 0;     ///< its entity
  bool          has_unit     = false; ///< a unit of length, and a context it is assigned in
};

/// Reads the file once, outside of strings and comments; entities of any schema.
StepText read_step_text(const std::string &path);

} // namespace gestell::fem
