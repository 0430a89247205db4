#pragma once

#include <optional>
#include <vector>

namespace gestell::apps
{

/// Of cell sizes that are compared: the coarser mesh has a third of the coordinates in solids, so it costs little.
constexpr double ratio_of_meshes = 1.5;

/// Errors of an output by their cause, of what is allowed; infinite: not known.
struct Shares
{
  double sides = 0., degree = 0., modes = 0., time = 0.;

  double mesh() const { return sides + degree; }
  double total() const { return mesh() + modes + time; }
};

/// The largest of all outputs, of one cause.
double largest(const std::vector<Shares> &outputs, double Shares::*cause);

/// A mesh that was judged.
struct MeshPoint
{
  double              size        = 1.; ///< of the cells, of that in the scene
  double              coordinates = 0.;
  double              cpu_s       = 0.;
  std::vector<Shares> shares; ///< by output
};

/**
 * The coarsest mesh of one kind whose largest error, sides + degree + modes + time, is expected within `aim`:
 *
 *     degree ~ h^q,   coordinates ~ h^-r,   CPU time ~ coordinates^1.2,   sides constant
 *
 * q between 1 of a sharp corner and 4 of smooth fields, r between 1 and 3, both from the two finest points.  Of one
 * point q = 3 and r = 2, and the mesh is at most twice as fine, where the law can be seen.
 *
 * @param points  of meshes of one kind
 * @param others  modes and time that the next model will have, by output
 * @param coarsest  size
 * @return nothing where sides alone are above the aim, or not known
 */
std::optional<MeshPoint> coarsest_within(double aim, std::vector<MeshPoint> points, const std::vector<Shares> &others,
                                         double coarsest);

/// Modes, of a ladder, with which a share falls to `aim`: the error of m modes falls at least like m^-2.
int modes_for(double aim, int modes, double share);

/// From there on the numbers of modes that are tried.
const std::vector<int> &mode_ladder();

} // namespace gestell::apps
