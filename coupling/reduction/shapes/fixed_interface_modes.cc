#include "coupling/reduction/shapes/fixed_interface_modes.h"

#include "coupling/algebra/dense_modes.h"

#include <algorithm>

namespace gestell::coupling
{

namespace
{

using Eigen::MatrixXd;

} // namespace

FixedInterfaceModes::FixedInterfaceModes(FixedInterfaceFrame &held, const fem::FrameMatrices &frame,
                                         const std::vector<int> &q1, const BlockLanczos::Options &options)
    : SturmCheckedModes("fixed-interface modes", int(frame.M.rows()) - int(q1.size()) <= dense_limit, options,
                        held.stiffness_diagonal()),
      held_(held), frame_(frame)
{
  for (int i = 0; i < int(frame.M.rows()); ++i)
    if (!std::binary_search(q1.begin(), q1.end(), i))
      q2_.push_back(i);
}

int FixedInterfaceModes::n() const
{
  return int(frame_.M.rows());
}

/// All modes by a dense solver: with few coordinates a Krylov space would be too small.
LowestModes FixedInterfaceModes::all() const
{
  held_.take_back();
  const MatrixXd M = frame_.M, C = frame_.C;
  const auto     modes = dense_modes(C(q2_, q2_), M(q2_, q2_));
  LowestModes all{modes.omega, MatrixXd::Zero(M.rows(), modes.omega.size()), Eigen::VectorXd::Zero(modes.omega.size())};
  all.V(q2_, Eigen::all) = modes.V;
  return all;
}

std::unique_ptr<ModeSearch> FixedInterfaceModes::search(const BlockLanczos::Options &options,
                                                        const LowestModes           &known) const
{
  return held_.search(options, known);
}

} // namespace gestell::coupling
