#include "coupling/plugin/frame/prestressed.h"

#include "coupling/eigensolvers/slepc/buckling.h"
#include "coupling/factors/make_factor.h"
#include "coupling/substructures/prestress_statement.h"
#include "coupling/substructures/prestressed_parts.h"
#include "fem/assembly/rigid_body_modes.h"
#include "fem/assembly/rigid_motions.h"
#include "fem/assembly/sparse_sum.h"
#include "fem/values/available_memory.h"

#include <Eigen/Cholesky>

#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

namespace gestell::coupling
{

namespace
{

using Eigen::MatrixXd;
using Eigen::VectorXd;

[[noreturn]] void refuse(const fem::Prestress &prestress, const std::string &message)
{
  throw std::invalid_argument((prestress.place.empty() ? "prestress" : prestress.place) + ": " + message);
}

void require_loads(const fem::Discretisation &linear, const fem::Prestress &prestress)
{
  if (linear.prestress_load.isZero(0.))
    refuse(prestress, "its loads are zero; give the scene a 'gravity', or a load a 'force' or a 'pressure'");
}

/// Solutions with the stiffness of the frame, held coordinates fixed.
std::unique_ptr<StiffnessFactor> factor_of(const fem::FrameMatrices &frame, const std::vector<int> &held,
                                           const fem::Prestress &prestress, const std::string &name)
{
  const auto free = fem::free_motions(frame, held);
  if (!free.empty())
    refuse(prestress, "the supports leave the frame free to move (" + free.front() +
                          "), so its loads have no static equilibrium; add a support");
  FactorMatrices matrices;
  matrices.C         = &frame.C;
  matrices.held      = held;
  matrices.available = fem::available_memory();
  auto factor        = make_factor(name, std::move(matrices));
  factor->factorise();
  return factor;
}

/// (0; C22^-1 (f2 - C21 q1)) + (q1; 0)
VectorXd static_deflection(const StiffnessFactor &factor, const fem::Discretisation &frame, const std::vector<int> &q1,
                           const std::vector<double> &motion)
{
  VectorXd given = VectorXd::Zero(frame.prestress_load.size());
  for (std::size_t i = 0; i < q1.size(); ++i)
    given[q1[i]] = motion[i];
  VectorXd q = frame.prestress_load - frame.matrices.C * given;
  factor.solve_in_place(q);
  return q + given;
}

Eigen::SparseMatrix<double> at(const std::vector<int> &q1, const MatrixXd &D, Eigen::Index n)
{
  std::vector<Eigen::Triplet<double>> entries;
  for (Eigen::Index i = 0; i < D.rows(); ++i)
    for (Eigen::Index j = 0; j < D.cols(); ++j)
      entries.emplace_back(q1[std::size_t(i)], q1[std::size_t(j)], D(i, j));
  Eigen::SparseMatrix<double> all(n, n);
  all.setFromTriplets(entries.begin(), entries.end());
  return all;
}

/**
 * Lets a prestressed part float, as reductions expect. With the free motions R of the part without prestress, for which
 * C' R = K R, C' = C + K, the interior is in equilibrium in
 *
 *     R^ = R - (0; C'22^-1 (K R)_2),     C' R^ = (G; 0),
 *
 * so that C' + D has the free motions R^ for a D of interface coordinates with D R_1 = -G:
 *
 *     P = (R_1^T R_1)^-1 R_1^T,   D = -(G P + P^T G^T - P^T R_1^T G P).
 *
 * The coordinates of D remain, so that it can be subtracted from the reduced stiffness.
 *
 * @param inverse  C'22^-1.
 */
void balance(const StiffnessFactor &inverse, const fem::FrameMatrices &linear, const std::vector<int> &q1,
             fem::Discretisation &stressed)
{
  const MatrixXd R = fem::free_displacements(linear);
  if (R.cols() == 0)
    return;
  const auto inner = [&](MatrixXd X)
  {
    inverse.solve_in_place(X);
    return X;
  };
  const MatrixXd KR = stressed.geometric * R, G = (KR - stressed.matrices.C * inner(KR))(q1, Eigen::all),
                 R_1 = R(q1, Eigen::all);
  const MatrixXd P = (R_1.transpose() * R_1).ldlt().solve(R_1.transpose()), GP = G * P;
  const MatrixXd D = P.transpose() * (R_1.transpose() * GP) - GP - GP.transpose();
  stressed.balance = 0.5 * (D + D.transpose());
  stressed.matrices.rigid_motions -= inner(stressed.geometric * linear.rigid_motions);
  fem::add(stressed.matrices.C, at(q1, stressed.balance, KR.rows()));
}

/// T^T K T of the geometric stiffness of nodes and parts.
MatrixXd reduced_geometric(const MatrixXd &T, const fem::Discretisation &stressed, const fem::CellParts &parts)
{
  MatrixXd K = T.transpose() * (stressed.geometric * T);
  for (int p = 0; p < parts.size(); ++p)
  {
    const MatrixXd own = T(parts.coordinates(p), Eigen::all);
    K += own.transpose() * (parts.geometric(p) * own);
  }
  return K;
}

} // namespace

fem::Discretisation discretised(const fem::Mesh &mesh, const fem::FrameSpecification &specification,
                                const std::string &factor, const Progress &progress)
{
  fem::Discretisation linear = fem::discretise_with_mesh_error(mesh, specification);
  if (!specification.prestress)
    return linear;
  const fem::Prestress &prestress = *specification.prestress;
  if (progress)
    progress("prestress", -1.);
  const bool             is_part = !prestress.interface_motion.empty();
  const std::vector<int> held    = is_part ? linear.matrices.interface_coordinates() : std::vector<int>();
  if (!is_part)
    require_loads(linear, prestress);
  const auto     C_inverse     = factor_of(linear.matrices, held, prestress, factor);
  const VectorXd q0            = static_deflection(*C_inverse, linear, held, prestress.interface_motion);
  linear.matrices.M            = fem::SparseMatrix(); // room for the second discretisation
  linear.matrices.B            = fem::SparseMatrix();
  linear.matrices.stress       = {};
  linear.mesh_error            = {};
  fem::Discretisation stressed = fem::discretise_with_mesh_error(mesh, specification, q0);
  const auto          inverse  = std::make_shared<InverseByColumns>(
      int(q0.size()), [&](Eigen::Ref<MatrixXd> X) { C_inverse->solve_in_place(X); }, held);
  const double lambda = buckling_factor(inverse, linear.matrices.C, stressed.geometric);
  require_below_buckling(lambda, prestress.place);
  add_buckling(lambda, BucklingValue::exact, is_part ? " with the interfaces fixed" : "", stressed.matrices.statements,
               stressed.matrices.facts);
  if (is_part)
  {
    C_inverse->release();
    balance(*factor_of(stressed.matrices, held, prestress, factor), linear.matrices, held, stressed);
  }
  return stressed;
}

ReducedModel reduce_prestressed_in_parts(fem::Discretisation &frame, const fem::CellParts &parts, const fem::Mesh &mesh,
                                         const fem::FrameSpecification &specification, const ReductionOptions &options,
                                         const PartsCall &call)
{
  require_loads(frame, *specification.prestress);
  const VectorXd q0            = deflection_in_parts(frame.matrices, parts, frame.prestress_load, call);
  frame.matrices.stress        = {}; // room for the second discretisation
  fem::Discretisation stressed = fem::discretise_for_parts(mesh, specification, q0);
  const auto          about    = stressed.mesh_error->parts(parts.size(), specification.place);
  const auto          bound    = [&](const ReducedModel &reduced, double contained)
  {
    const MatrixXd K      = reduced_geometric(reduced.basis.T, stressed, about);
    const double   lambda = dense_buckling_factor(reduced.frame.C - contained * K, K);
    require_below_buckling(lambda, call.prestress, BucklingValue::upper_bound);
    return lambda;
  };
  ReducedModel reduced;
  try
  {
    reduced = reduce_in_parts(stressed.matrices, about, options, call);
  }
  catch (const std::invalid_argument &failure) // one of buckling, perhaps of a child process, knows no factor
  {
    if (std::string(failure.what()).find("prestress beyond buckling") == std::string::npos)
      throw;
    PartsCall unstressed = call;
    unstressed.prestress.clear();
    bound(reduce_in_parts(frame.matrices, parts, options, unstressed), 0.);
    throw;
  }
  add_buckling(bound(reduced, 1.), BucklingValue::upper_bound, " in the reduced DOFs", reduced.frame.statements,
               reduced.frame.facts);
  frame = std::move(stressed);
  return reduced;
}

} // namespace gestell::coupling
