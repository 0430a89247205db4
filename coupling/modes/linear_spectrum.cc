#include "coupling/modes/linear_spectrum.h"

#include "coupling/algebra/circulatory_modes.h"
#include "coupling/machine/configuration/dense_matrices.h"
#include "coupling/machine/configuration/local_stiffness.h"
#include "coupling/modes/modes.h"

#include <algorithm>
#include <cmath>

namespace gestell::coupling
{

namespace
{

Eigen::MatrixXd symmetric(const Eigen::MatrixXd &A)
{
  return 0.5 * (A + A.transpose());
}

struct Geometric
{
  Eigen::MatrixXd K;                   ///< [n x n]
  bool            circulatory = false; ///< K is not symmetric
};

/// Geometric stiffness of the forces when the machine starts from rest; zero if these cannot be computed, since a run
/// reports a failed start itself.
Geometric geometric_at_rest(const Machine &machine, const InitialState &start, LocalState &local)
{
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(machine.size());
  local.resize(machine);
  machine.gather(start.t, start.q, zero, zero, local);
  if (machine.joints().n_rows() > 0)
    try
    {
      local.lambda = multipliers_at_rest(machine, start.q, local);
    }
    catch (const ConvergenceFailure &)
    {
      return {Eigen::MatrixXd::Zero(machine.size(), machine.size())};
    }
  const Eigen::MatrixXd K           = geometric_stiffness(machine, local);
  const bool            circulatory = is_circulatory(machine, local, Eigen::VectorXd::Ones(local.u.size()));
  return {circulatory ? K : symmetric(K), circulatory};
}

/// The linearised machine in free motions; C with geometric stiffness.
struct Whole
{
  Eigen::MatrixXd M, B, C;
  bool            circulatory;
};

/// K and D are what elements add to B and C.
LinearMachine in_modes(ModeOrigin origin, const Whole &whole, const Eigen::MatrixXd &K, const Eigen::MatrixXd &D)
{
  const auto &[M, B, C, circulatory] = whole;
  LinearMachine result{origin, {}, {}, {}, {}};
  const auto   &V = result.modes.V;
  if (circulatory)
  {
    CirculatoryModes found = circulatory_modes(C + K, M);
    result.modes           = std::move(found.modes);
    result.B               = found.left.transpose() * (B + D) * V;
    result.C               = found.left.transpose() * (C + K) * V;
  }
  else
  {
    result.modes = dense_modes(C + K, M);
    result.B     = symmetric(V.transpose() * (B + D) * V);
  }
  result.contact_omega = (V.cwiseProduct(K * V)).colwise().sum().cwiseMax(0.).cwiseSqrt();
  return result;
}

// --- large machines

/// Stiffness [n_u x n_u] of all elements in the stiffest branch of their laws.
Eigen::SparseMatrix<double> stiffest_of_measures(const Machine &machine, const Eigen::VectorXd &q)
{
  const Eigen::VectorXd               u = machine.forces().directions().transpose() * q;
  std::vector<Eigen::Triplet<double>> entries;
  int                                 first = 0;
  for (const ElementPlacement &placement : machine.model().elements())
  {
    const int       k = placement.element->n_measures();
    Eigen::MatrixXd K = Eigen::MatrixXd::Zero(k, k), D = K;
    stiffest(*placement.element, u.data() + first, K.data(), D.data());
    for (int i = 0; i < k; ++i)
      for (int j = 0; j < k; ++j)
        if (K(i, j) != 0.)
          entries.emplace_back(first + i, first + j, K(i, j));
    first += k;
  }
  Eigen::SparseMatrix<double> K(u.size(), u.size());
  K.setFromTriplets(entries.begin(), entries.end());
  return K;
}

/// The highest frequency by power iteration on M^-1 C, approached from below; two hundred steps come within a per cent.
LargeMode highest_mode(const Machine &machine, const Eigen::VectorXd &q, double damping_ratio)
{
  const auto  mass = machine.linear().factorise(1., 0., 0.);
  const auto &W    = machine.forces().directions();
  const auto  K    = stiffest_of_measures(machine, q);

  Eigen::VectorXd x(machine.size()), y(x.size()), z(x.size());
  for (Eigen::Index i = 0; i < x.size(); ++i)
    x[i] = std::cos(1.7 * double(i) * double(i)); // rough, so that no high mode is missed
  double omega = 0.;
  for (int i = 0; i < 200; ++i)
  {
    machine.linear().stiffness_times(x, y);
    y += W * (K * (W.transpose() * x));
    machine.linear().mass_times(x, z);
    omega = std::sqrt(std::max(0., x.dot(y) / x.dot(z)));
    mass->solve(y, x);
    x /= x.norm();
  }
  const ModeOrigin origin = K.nonZeros() > 0 ? ModeOrigin::closed : ModeOrigin::base;
  return {origin, machine.size(), {omega, damping_ratio}, true};
}

std::vector<LargeMode> modes_of_large(const Machine &machine, const Eigen::VectorXd &q)
{
  std::vector<LargeMode> result;
  int                    number = 0;
  double                 least  = 1.;
  for (const SpectrumLine &line : machine.linear().spectrum())
  {
    ++number;
    if (line.omega <= 0.)
      continue;
    result.push_back({ModeOrigin::base, number, line});
    least = std::min(least, line.zeta);
  }
  if (number < machine.size())
    result.push_back(highest_mode(machine, q, std::max(0., least)));
  return result;
}

} // namespace

bool is_large(const Machine &machine)
{
  Eigen::MatrixXd M, B, C;
  return machine.model().full_frame() || !machine.linear().dense_matrices(M, B, C);
}

LinearSpectrum linear_spectrum(const Machine &machine, const InitialState &start)
{
  if (is_large(machine))
    return {{}, modes_of_large(machine, start.q)};
  LocalState            local;
  const Geometric       geometric = geometric_at_rest(machine, start, local);
  const bool            jointed   = machine.joints().n_rows() > 0;
  const Eigen::MatrixXd Z         = jointed ? free_motions(machine, local) : Eigen::MatrixXd();
  const auto      free = [&](const Eigen::MatrixXd &A) { return jointed ? Eigen::MatrixXd(Z.transpose() * A * Z) : A; };
  const Whole     whole{free(dense_mass(machine)), free(dense_damping(machine)),
                    free(dense_stiffness(machine) + geometric.K), geometric.circulatory};
  Eigen::MatrixXd K, D, stiffest_K, stiffest_D;
  open_matrices(machine, start.q, K, D);
  stiffest_matrices(machine, start.q, stiffest_K, stiffest_D);

  LinearSpectrum result;
  result.machines.push_back(in_modes(ModeOrigin::base, whole, free(symmetric(K)), free(symmetric(D))));
  if (stiffest_K != K || stiffest_D != D)
    result.machines.push_back(
        in_modes(ModeOrigin::closed, whole, free(symmetric(stiffest_K)), free(symmetric(stiffest_D))));
  return result;
}

} // namespace gestell::coupling
