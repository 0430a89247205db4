#include "fem/recovery/raised_matrices.h"

#include <algorithm>

namespace gestell::fem
{

namespace
{

using Sparse = Eigen::SparseMatrix<double>;

/// P of the places.
Sparse placed_at(const std::vector<int> &place, Eigen::Index n)
{
  std::vector<Eigen::Triplet<double>> ones;
  for (std::size_t i = 0; i < place.size(); ++i)
    ones.emplace_back(place[i], int(i), 1.);
  Sparse P(n, Eigen::Index(place.size()));
  P.setFromTriplets(ones.begin(), ones.end());
  return P;
}

Sparse embedded(const Sparse &P, const SparseMatrix &A)
{
  return P * Sparse(Sparse(A) * Sparse(P.transpose()));
}

/// Whether the output reads quadratic displacements only: those of foundations, which act on these.
bool read_off_quadratics(const FrameOutput &output, const FrameSpecification &specification)
{
  return std::any_of(specification.supports.begin(), specification.supports.end(),
                     [&](const Support &support) {
                       return support.kind == SupportKind::foundation &&
                              output.name.rfind("support." + support.name + ".", 0) == 0;
                     });
}

} // namespace

FrameMatrices raised_matrices(const Discretisation &quadratic, const FrameSpecification &specification)
{
  const FrameMatrices &frame  = quadratic.matrices;
  RaisedFrame          degree = quadratic.mesh_error->raised(frame);
  const Sparse         P      = placed_at(degree.place, degree.C.rows());
  const double         alpha = specification.rayleigh_mass, beta = specification.rayleigh_stiffness;

  FrameMatrices raised;
  Sparse        B = embedded(P, frame.B);
  if (beta > 0.)
    B += beta * (Sparse(degree.C) - embedded(P, frame.C));
  if (alpha > 0.)
    B += alpha * (Sparse(degree.M) - embedded(P, frame.M));
  raised.B                   = B;
  raised.modal_damping_ratio = frame.modal_damping_ratio;
  raised.interfaces          = frame.interfaces;
  for (Interface &interface : raised.interfaces)
    interface.renumber([&](int i) { return degree.place[std::size_t(i)]; });
  raised.translations  = P * frame.translations;
  raised.rigid_motions = P * frame.rigid_motions;
  // The cubic coordinates get the load of an unclamped frame, the quadratic ones their own load.
  const Eigen::MatrixXd own = P * frame.acceleration_load, all = degree.M * raised.translations;
  const Eigen::VectorXd is_own = P * Eigen::VectorXd::Ones(P.cols());
  raised.acceleration_load     = (is_own.array() > 0.).replicate(1, 3).select(own, all);
  raised.centre                = frame.centre;
  for (FrameOutput output : frame.outputs)
    if (read_off_quadratics(output, specification))
    {
      output.on_q = P * output.on_q;
      output.on_v = P * output.on_v;
      raised.outputs.push_back(std::move(output));
    }
  raised.picture              = frame.picture;
  raised.picture.displacement = frame.picture.displacement * Sparse(P.transpose());
  raised.facts                = frame.facts;
  raised.mass                 = frame.mass;
  raised.n_cells              = frame.n_cells;
  raised.notes                = frame.notes;
  raised.statements           = frame.statements;
  raised.C                    = std::move(degree.C);
  raised.M                    = std::move(degree.M);
  return raised;
}

} // namespace gestell::fem
