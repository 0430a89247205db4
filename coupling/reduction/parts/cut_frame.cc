#include "coupling/reduction/parts/cut_frame.h"

#include "coupling/reduction/shapes/interface_statics.h"

namespace gestell::coupling
{

namespace
{
using Sparse = Eigen::SparseMatrix<double>;

/// A row in some of the coordinates.
fem::FrameOutput taken(fem::FrameOutput row, const std::vector<int> &coordinates)
{
  for (Eigen::VectorXd *of : {&row.on_q, &row.on_v, &row.on_a})
    if (of->size() > 0)
      *of = Eigen::VectorXd((*of)(coordinates));
  return row;
}
} // namespace

CutFrame::CutFrame(const fem::FrameMatrices &frame, const fem::CellParts &parts, const PartsCall &call)
    : frame_(frame), parts_(parts), call_(call), interface_(parts, frame.interface_coordinates()), damping_(frame.B),
      forces_(force_outputs(frame.outputs))
{
  if (call.alpha > 0.)
    damping_ = Sparse(damping_ - call.alpha * frame.M);
  if (call.beta > 0.)
    damping_ = Sparse(damping_ - call.beta * frame.C);
}

std::vector<std::size_t> CutFrame::forces(int p) const
{
  const std::vector<int> coordinates = parts_.coordinates(p);
  const auto             acts        = [&](const Eigen::VectorXd &row)
  {
    return row.size() > 0 && std::any_of(coordinates.begin(), coordinates.end(),
                                         [&](int i) { return interface_.place(i) < 0 && row[i] != 0.; });
  };
  std::vector<std::size_t> found;
  for (std::size_t k = 0; k < forces_.size(); ++k)
    if (const fem::FrameOutput &force = frame_.outputs[forces_[k]];
        acts(force.on_q) || acts(force.on_v) || acts(force.on_a))
      found.push_back(k);
  return found;
}

PartOfFrame CutFrame::part(int p) const
{
  PartOfFrame part;
  part.sums      = sums(p);
  part.stiffness = [this, p] { return std::move(sums(p).C); };
  part.name      = name(p);
  part.prestress = call_.prestress;
  part.damping   = interface_.share(damping_, p, part.sums.coordinates);
  part.held      = interface_.held(part.sums.coordinates);
  part.load      = frame_.acceleration_load(part.sums.coordinates, Eigen::all);
  part.alpha     = call_.alpha;
  for (const std::size_t k : forces(p))
    part.forces.push_back(taken(frame_.outputs[forces_[k]], part.sums.coordinates));
  return part;
}

fem::PartMatrices CutFrame::sums(int p) const
{
  fem::PartMatrices sums = parts_.matrices(p);
  for (const auto &[own, of_frame] : {std::pair(&sums.C, &frame_.C), std::pair(&sums.M, &frame_.M)})
    if (of_frame->nonZeros() > 0)
      *own = Sparse(*own + interface_.share(*of_frame, p, sums.coordinates));
  return sums;
}

} // namespace gestell::coupling
