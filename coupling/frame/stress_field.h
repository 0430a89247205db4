#pragma once

#include "coupling/frame/reduced_stress.h"

#include <Eigen/Core>

namespace gestell::coupling
{

/// Components xx yy zz xy yz xz [Pa], tension positive.
using Stress = Eigen::Matrix<double, fem::stress_components, 1>;

/**
 * Equivalent stress of Huber, von Mises and Hencky,
 *
 *     sigma_v^2 = 3/2 s : s,   s = sigma - tr(sigma)/3 I.
 */
double von_mises(const Stress &sigma);

struct PrincipalStresses
{
  Eigen::Vector3d values; ///< descending
  Eigen::Vector3d first;  ///< unit vector of values[0], its largest component positive
};
PrincipalStresses principal_stresses(const Stress &sigma);

/// (p; g) for a machine's coordinates q, the first of which are those of the frame.
Eigen::VectorXd stress_state(const ReducedStress &stress, const Eigen::VectorXd &q, const std::array<double, 3> &g);

/// The stress at every point at one instant.
struct StressField
{
  Eigen::Matrix<double, 6, Eigen::Dynamic> components; // [6 x points] Pa
  Eigen::VectorXd                          von_mises;  // [points] Pa

  Stress at(int point) const { return components.col(point); }
};

/// @param state  (p; g) [n1 + m + 3]
StressField stress_field(const ReducedStress &stress, const Eigen::VectorXd &state);

/**
 * Disagreement of adjacent elements on the stress at a point: the root mean square of sigma_v of the deviation of
 * single elements from the mean, over the point and those that share a triangle with it, divided by sigma_v at the
 * point.  It falls with the square of the element size where the stress is smooth, and does not fall at a singularity.
 */
double disagreement(const ReducedStress &stress, const Eigen::VectorXd &state, int point);

} // namespace gestell::coupling
