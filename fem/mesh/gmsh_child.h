#pragma once

#include "fem/process/child.h"
#include "fem/values/cad_source.h"

#include <stdexcept>
#include <string>

namespace gestell::fem
{

/// Task of the child that reads a file with gmsh, with the limits for that file.
ChildTask gmsh_task(const CadSource &source, const std::string &phase);

/// in_child(), with a check that all numbers of its value are finite.
/// @param phase  of `work` that reads the file
template <typename Value, typename Work>
Value in_gmsh_child(const CadSource &source, const std::string &phase, const ChildProgress &progress, const Work &work)
{
  const ChildTask task = gmsh_task(source, phase);
  return in_child<Value>(task, progress,
                         [&](const ChildProgress &on_progress)
                         {
                           Value value = work(on_progress);
                           if (!is_finite(value))
                             throw std::invalid_argument(task.head +
                                                         ": gmsh finds lengths or volumes in it that are not "
                                                         "finite; the file is damaged: export the model again.");
                           return value;
                         });
}

} // namespace gestell::fem
