#include "coupling/machine/machine.h"
#include "coupling/machine/machine_parts.h"
#include "mechanism/joints/orthonormal_directors.h"

#include <Eigen/Eigenvalues>

#include <cmath>
#include <sstream>

namespace gestell::coupling
{

// Free spatial bodies: docs/theory/joints.md, (6a).

namespace
{

std::string listed(const Eigen::Vector3d &moments)
{
  std::ostringstream text;
  text << moments[0] << ", " << moments[1] << " and " << moments[2] << " kg m^2";
  return text.str();
}
} // namespace

int MachineModel::add_rigid(const std::string &name, double mass, const Eigen::Matrix3d &inertia,
                            const Vector3 &position)
{
  const std::string what = "rigid body \"" + name + "\"";
  if (!(mass > 0.) || !std::isfinite(mass))
    throw std::invalid_argument(what + ": mass [kg] is " + std::to_string(mass) + "; it must be positive");
  std::vector<std::string> names{name + ".ux", name + ".uy", name + ".uz"};
  for (const char director : {'1', '2', '3'})
    for (const char axis : {'x', 'y', 'z'})
      names.push_back(name + ".d" + director + axis);
  const int first = parts_->add_coordinates(name, names);
  parts_->add_inertia(what, inertia, first + 3, true);
  Marker own;
  own.name         = name;
  own.turns_freely = true;
  for (int d = 0; d < 3; ++d)
    own.translation[d] = {{first + d, 1.}};
  parts_->add_mass(mass, own.translation);
  parts_->add_body({name, BodyKind::rigid, first, {}, position, 0., {}, own, position});
  std::vector<Measure> directors;
  for (int i = 0; i < mechanism::OrthonormalDirectors::n_directors; ++i)
    directors.push_back({{first + 3 + i, 1.}});
  attach(name, std::make_shared<mechanism::OrthonormalDirectors>(), directors);
  return first;
}

/// T = 1/2 sum E_ij d_i' . d_j',  E = 1/2 tr(J) - J.
void MachineParts::add_inertia(const std::string &what, const Eigen::Matrix3d &inertia, int first, bool is_whole_body)
{
  const double largest = inertia.cwiseAbs().maxCoeff();
  if (!inertia.allFinite() || (inertia - inertia.transpose()).cwiseAbs().maxCoeff() > 1e-9 * largest)
    throw std::invalid_argument(what + ": the inertia tensor must be symmetric, J_xy = J_yx (the negative products of "
                                       "inertia), J_yz = J_zy, J_zx = J_xz");
  const Eigen::Matrix3d E       = 0.5 * inertia.trace() * Eigen::Matrix3d::Identity() - inertia;
  const Eigen::Vector3d moments = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(inertia).eigenvalues();
  const double          least   = 0.5 * (moments[0] + moments[1] - moments[2]); // smallest eigenvalue of E
  if (is_whole_body && !(moments[0] > 0.))
    throw std::invalid_argument(what + ": the principal moments of inertia are " + listed(moments) +
                                "; all must be positive: give a slender rod the inertia about its own axis");
  if (least < -1e-9 * moments[2])
    throw std::invalid_argument(
        what + ": the principal moments of inertia are " + listed(moments) +
        "; none may exceed the sum of the other two: check the values, and that they refer to the centre of mass");
  // Smallest share of E in the largest moment: a thinner body cannot be distinguished from one without thickness.
  constexpr double thinnest = 1e-10;
  if (is_whole_body && !(least > thinnest * moments[2]))
    throw std::invalid_argument(what + ": the principal moments of inertia are " + listed(moments) +
                                ": the largest is the sum of the others, so the body has no thickness and its mass "
                                "matrix is singular; a thickness t adds m t^2/12 to the two smaller ones");
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      for (int d = 0; d < 3; ++d)
        if (E(i, j) != 0.)
          M.emplace_back(first + 3 * i + d, first + 3 * j + d, E(i, j));
}

void MachineParts::refuse_free_carrier(const Marker &carrier, const std::string &what) const
{
  if (carrier.turns_freely)
    throw std::invalid_argument(what + ": its carrier \"" + carrier.name +
                                "\" is a free spatial body, which its axis cannot follow; make it a rigid body with a "
                                "revolute or prismatic joint");
}

std::array<Measure, 3> MachineParts::moved_point(const Marker &marker, const Vector3 &arm) const
{
  std::array<Measure, 3> moved = marker.translation;
  if (marker.turns_freely) // linear in the directors for any rotation
  {
    const int first = marker.translation[0].front().first + 3;
    for (int d = 0; d < 3; ++d)
      for (int i = 0; i < 3; ++i)
        moved[d] = moved[d] + arm[i] * Measure{{first + 3 * i + d, 1.}};
    return moved;
  }
  for (int d = 0; d < 3; ++d)
  {
    const int e = (d + 1) % 3, f = (d + 2) % 3; // (theta x r)_d = theta_e r_f - theta_f r_e
    moved[d] = moved[d] + arm[f] * marker.rotation[e] - arm[e] * marker.rotation[f];
  }
  return moved;
}

} // namespace gestell::coupling
