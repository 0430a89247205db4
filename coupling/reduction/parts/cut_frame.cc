#include "coupling/reduction/parts/cut_frame.h"

namespace gestell::coupling
{

namespace
{
using Sparse = Eigen::SparseMatrix<double>;
}

CutFrame::CutFrame(const fem::FrameMatrices &frame, const fem::CellParts &parts, const PartsCall &call)
    : frame_(frame), parts_(parts), call_(call), interface_(parts, frame.interface_coordinates()), damping_(frame.B)
{
  if (call.alpha > 0.)
    damping_ = Sparse(damping_ - call.alpha * frame.M);
  if (call.beta > 0.)
    damping_ = Sparse(damping_ - call.beta * frame.C);
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
