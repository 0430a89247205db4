#pragma once

#include "coupling/frame/reduced_frame.h"
#include "coupling/substructures/frame_of_parts.h"

#include <Eigen/Core>

#include <vector>

namespace gestell::coupling
{

/// All parts, not joined: q = (q_1, q_2, ...), block diagonal matrices.
struct PartUnion
{
  Eigen::MatrixXd               M, B, C;           // [n x n]
  Eigen::MatrixXd               translations_load; // [n x 3]
  std::vector<fem::Interface>   interfaces;        ///< coordinates in q
  std::vector<fem::FrameOutput> outputs;           // rows on q
  std::vector<Eigen::Index>     first;             ///< coordinate of each part

  Eigen::Index          size() const { return M.rows(); }
  const fem::Interface &at(const JointEnd &end) const; ///< must exist, see require_joints()
};

/// @param parts  in their positions, see placed().
PartUnion beside_each_other(const std::vector<ReducedFrame> &parts);

/// Motions ux ... rz of an interface [6 x n], which has all six.
Eigen::MatrixXd motions_of(const fem::Interface &interface, Eigen::Index n);

/// The same, followed by the fields over its face [6 + n_fields x n].
Eigen::MatrixXd all_motions_of(const fem::Interface &interface, Eigen::Index n);

/// Position [m].
Eigen::Vector3d position_of(const fem::Interface &interface);

/// q of the rigid-body motions ux ... rz of the whole about a point [n x 6]; modes of parts are zero.
Eigen::MatrixXd rigid_motions_of(const PartUnion &parts, const Eigen::Vector3d &centre);

} // namespace gestell::coupling
