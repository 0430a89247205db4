#pragma once

#include "fem/geometry/read_cad.h"
#include "fem/process/child.h"
#include "fem/values/cad_source.h"
#include "fem/values/frame_specification.h"
#include "fem/values/mesh_phase.h"

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

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

/// gmsh fails on sound geometry, with elements of this size.
class NotMeshed : public std::invalid_argument
{
public:
  using std::invalid_argument::invalid_argument;
};

/// Which curved faces of thin walls get a size by the thickness of the wall.
enum class WallSizes
{
  where_needed, ///< those whose triangles would cut through the wall
  everywhere
};

/// A way to mesh a frame.
struct MeshAttempt
{
  FrameSpecification specification; ///< with the size of this attempt
  WallSizes          walls = WallSizes::where_needed;
  std::string        text; ///< "cells of 67 mm, ..."
};

/// The given size; the same with sizes of curved faces by the thickness of their walls; so with 2/3, 4/9, 8/27 of it.
std::vector<MeshAttempt> mesh_attempts(const FrameSpecification &specification);

/// Note of a mesh that succeeded after failures.
std::string note_of(const MeshAttempt &attempt, const std::string &first_failure);

/// A value, or the reason why there is none.
template <typename Value>
struct Tried
{
  Value       value{};
  std::string failure{};
};

template <typename Archive, typename Value>
void exchange(Archive &archive, Tried<Value> &tried)
{
  auto &[value, failure] = tried;
  archive(value, failure);
}

/**
 * The value of the first of mesh_attempts() that succeeds, each in a child of its own. An attempt fails if `work`
 * throws NotMeshed, or if a fault of gmsh ends the child after reading. A note of the value names the attempt that
 * succeeded and the first failure.
 *
 * @param work  (MeshAttempt, ChildProgress) -> Value with a member `notes`
 * @throws std::invalid_argument if all fail, or a smaller size is refused; other exceptions of `work` with the given
 * size
 */
template <typename Value, typename Work>
Value meshed_in_child(const FrameSpecification &specification, const ChildProgress &progress, const Work &work)
{
  std::string first, last; // failures
  for (const MeshAttempt &attempt : mesh_attempts(specification))
  {
    const auto tried_work = [&](const ChildProgress &on_progress)
    {
      try
      {
        return Tried<Value>{work(attempt, on_progress), ""};
      }
      catch (const NotMeshed &failure)
      {
        return Tried<Value>{{}, failure.what()};
      }
    };
    try
    {
      Tried<Value> tried =
          in_gmsh_child<Tried<Value>>(source_of(specification), mesh_phase::reading, progress, tried_work);
      if (tried.failure.empty() && !first.empty())
        tried.value.notes.push_back(note_of(attempt, first));
      if (tried.failure.empty())
        return std::move(tried.value);
      last = tried.failure;
    }
    catch (const ChildFault &fault)
    {
      last = fault.what();
    }
    catch (const std::invalid_argument &refusal)
    {
      if (first.empty())
        throw;
      throw std::invalid_argument(first + " With " + attempt.text + ": " + refusal.what());
    }
    if (first.empty())
      first = last;
  }
  throw std::invalid_argument(first + " Smaller sizes, down to 8/27 where one is given, fail, too.");
}

} // namespace gestell::fem
