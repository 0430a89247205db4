#pragma once

#include <Eigen/Core>

#include <optional>
#include <vector>

namespace gestell::apps
{

/// Ratio of the element sizes of two compared meshes. In solids the coarser mesh has a third of the DOFs.
constexpr double ratio_of_meshes = 1.5;

/// Errors of an output by their cause, relative to the allowed error; infinite: unknown.
struct Shares
{
  double sides = 0., degree = 0., modes = 0., time = 0.;

  double mesh() const { return sides + degree; }
  double total() const { return mesh() + modes + time; }
};

/// The largest share of one cause over all outputs.
double largest(const std::vector<Shares> &outputs, double Shares::*cause);

/// A mesh with known errors.
struct MeshPoint
{
  double              size        = 1.; ///< of the elements, relative to that in the scene
  double              coordinates = 0.;
  double              cpu_s       = 0.;
  std::vector<Shares> shares; ///< by output
};

/**
 * The coarsest mesh of one kind whose largest error, sides + degree + modes + time, is predicted to be within `aim`:
 *
 *     degree ~ h^q,   coordinates ~ h^-r,   CPU time ~ coordinates^1.2,   sides constant
 *
 * with q between 1 (sharp corner) and 4 (smooth fields) and r between 1 and 3, both from the two finest points.  With
 * one point q = 3 and r = 2, and the mesh is refined by two at most, to determine q and r.
 *
 * @param points    of meshes of one kind
 * @param others    errors of modes and time of the next model, by output
 * @param coarsest  upper limit of the size
 * @return none if the error of the sides alone exceeds the aim, or is unknown
 */
std::optional<MeshPoint> coarsest_within(double aim, std::vector<MeshPoint> points, const std::vector<Shares> &others,
                                         double coarsest);

/// Number of modes in mode_ladder() for which a share falls to `aim`: the error is assumed to fall like m^-2 or faster.
int modes_for(double aim, int modes, double share);

/// Power p with which errors of a reduction fall with the frequency of the first truncated mode,
/// docs/theory/reduction.md (16g) to (16i): of stresses and internal forces of the frame, which are recovered from its
/// motion, and of motions and forces of the machine.
/// @param superposed  the modes are those of the machine (5.5.3/8), without static shapes of its interfaces
double truncation_power(bool recovered, bool superposed);

/**
 * The error e of a reduction over its difference to a finer one.  With e ~ omega^-p, omega that of the first truncated
 * mode,
 *
 *     e = difference / (1 - (omega_kept+1 / omega_finer)^p),
 *
 * infinite if both frequencies are equal.
 *
 * @param omega  of the modes of the finer one, in any order
 * @param kept   number of modes of the coarser one; 1 if the finer one has no more
 */
double truncation_factor(Eigen::VectorXd omega, int kept, double power);

/// Numbers of modes that are tried.
const std::vector<int> &mode_ladder();

} // namespace gestell::apps
