#include "coupling/machine/configuration/dense_matrices.h"

#include "coupling/machine/configuration/coordinate_sizes.h"
#include "coupling/machine/configuration/local_stiffness.h"
#include "fem/values/nearest_name.h"

#include <Eigen/QR>

#include <algorithm>
#include <limits>

namespace gestell::coupling
{

namespace
{
template <typename Times>
Eigen::MatrixXd columns(int n, const Times &times)
{
  Eigen::MatrixXd matrix(n, n);
  Eigen::VectorXd column(n);
  for (int j = 0; j < n; ++j)
  {
    times(Eigen::VectorXd::Unit(n, j), column);
    matrix.col(j) = column;
  }
  return 0.5 * (matrix + matrix.transpose());
}
} // namespace

Eigen::MatrixXd dense_mass(const Machine &machine)
{
  return columns(machine.size(),
                 [&](const Eigen::VectorXd &x, Eigen::VectorXd &y) { machine.linear().mass_times(x, y); });
}

Eigen::MatrixXd dense_damping(const Machine &machine)
{
  return columns(machine.size(),
                 [&](const Eigen::VectorXd &x, Eigen::VectorXd &y) { machine.linear().damping_times(x, y); });
}

Eigen::MatrixXd dense_stiffness(const Machine &machine)
{
  return columns(machine.size(),
                 [&](const Eigen::VectorXd &x, Eigen::VectorXd &y) { machine.linear().stiffness_times(x, y); });
}

namespace
{

/// Calls add(first measure, K, D) for every element.
template <typename Matrices, typename Add>
void of_elements(const Machine &machine, const Eigen::VectorXd &u, const Matrices &of_element, const Add &add)
{
  int first = 0;
  for (const ElementPlacement &placement : machine.model().elements())
  {
    const int       k = placement.element->n_measures();
    Eigen::MatrixXd K = Eigen::MatrixXd::Zero(k, k), D = K;
    of_element(placement, u.data() + first, K, D);
    add(first, K, D);
    first += k;
  }
}

template <typename Matrices>
void add_up(const Machine &machine, const Eigen::VectorXd &q, Eigen::MatrixXd &stiffness, Eigen::MatrixXd &damping,
            const Matrices &of_element)
{
  const int             n = machine.size();
  const auto           &W = machine.forces().directions();
  const Eigen::VectorXd u = W.transpose() * q;
  stiffness.setZero(n, n);
  damping.setZero(n, n);
  of_elements(machine, u, of_element,
              [&](int first, const Eigen::MatrixXd &K, const Eigen::MatrixXd &D)
              {
                const Eigen::MatrixXd own = W.middleCols(first, K.cols());
                stiffness += own * K * own.transpose();
                damping += own * D * own.transpose();
              });
}

/// Matrices of engaged elements, except for those in `open`.
class Engaged
{
public:
  Engaged(const Machine &machine, const std::vector<std::string> &open) : open_(open) { check(machine); }

  void operator()(const ElementPlacement &placement, const double *u, Eigen::MatrixXd &K, Eigen::MatrixXd &D) const;

private:
  void check(const Machine &machine) const;

  const std::vector<std::string> &open_;
};

void Engaged::check(const Machine &machine) const
{
  std::vector<std::string> names;
  for (const ElementPlacement &placement : machine.model().elements())
    names.push_back(placement.name);
  for (const std::string &name : open_)
    if (std::find(names.begin(), names.end(), name) == names.end())
      throw std::invalid_argument("modes: there is no element \"" + name + "\" to be open" + suggestion(name, names));
}

void Engaged::operator()(const ElementPlacement &placement, const double *u, Eigen::MatrixXd &K,
                         Eigen::MatrixXd &D) const
{
  engaged(*placement.element, u, K.data(), D.data());
  if (std::find(open_.begin(), open_.end(), placement.name) == open_.end())
    return;
  const Eigen::MatrixXd engaged_K = K, engaged_D = D;
  open_branch(*placement.element, u, K.data(), D.data());
  if (K == engaged_K && D == engaged_D && !(K.isZero(0.) && D.isZero(0.)))
    throw std::invalid_argument("modes: element \"" + placement.name +
                                "\" acts in every position, so it cannot be open; remove it from modes.open, and for "
                                "modes without it also from the scene");
}

} // namespace

void engaged_matrices(const Machine &machine, const Eigen::VectorXd &q, const std::vector<std::string> &open,
                      Eigen::MatrixXd &stiffness, Eigen::MatrixXd &damping)
{
  add_up(machine, q, stiffness, damping, Engaged(machine, open));
}

Eigen::SparseMatrix<double> engaged_stiffness(const Machine &machine, const Eigen::VectorXd &q,
                                              const std::vector<std::string> &open)
{
  const auto                         &W = machine.forces().directions();
  const Eigen::VectorXd               u = W.transpose() * q;
  std::vector<Eigen::Triplet<double>> entries;
  of_elements(machine, u, Engaged(machine, open),
              [&](int first, const Eigen::MatrixXd &K, const Eigen::MatrixXd &)
              {
                for (int i = 0; i < K.rows(); ++i)
                  for (int j = 0; j < K.cols(); ++j)
                    if (K(i, j) != 0.)
                      entries.emplace_back(first + i, first + j, K(i, j));
              });
  Eigen::SparseMatrix<double> K(W.cols(), W.cols());
  K.setFromTriplets(entries.begin(), entries.end());
  return W * K * W.transpose();
}

void stiffest_matrices(const Machine &machine, const Eigen::VectorXd &q, Eigen::MatrixXd &stiffness,
                       Eigen::MatrixXd &damping)
{
  add_up(machine, q, stiffness, damping,
         [](const ElementPlacement &placement, const double *u, Eigen::MatrixXd &K, Eigen::MatrixXd &D)
         { stiffest(*placement.element, u, K.data(), D.data()); });
}

void open_matrices(const Machine &machine, const Eigen::VectorXd &q, Eigen::MatrixXd &stiffness,
                   Eigen::MatrixXd &damping)
{
  add_up(machine, q, stiffness, damping,
         [](const ElementPlacement &placement, const double *u, Eigen::MatrixXd &K, Eigen::MatrixXd &D)
         { open_branch(*placement.element, u, K.data(), D.data()); });
}

namespace
{

/// Whether it has stiffness or damping within `nearby` of u: a cubic spring has neither where it is relaxed.
bool is_structure(const mechanism::Element &element, const Eigen::VectorXd &u, double nearby)
{
  const auto      k = u.size();
  Eigen::MatrixXd K(k, k), D(k, k);
  const auto      acts_at = [&](const Eigen::VectorXd &at)
  {
    engaged(element, at.data(), K.data(), D.data());
    return !K.isZero(0.) || !D.isZero(0.);
  };
  bool acts = acts_at(u);
  for (Eigen::Index i = 0; !acts && i < k; ++i) // each separately: two together may leave a distance unchanged
    acts = acts_at(u + nearby * Eigen::VectorXd::Unit(k, i)) || acts_at(u - nearby * Eigen::VectorXd::Unit(k, i));
  return acts;
}

} // namespace

Eigen::VectorXd acting_measures(const Machine &machine, const Eigen::VectorXd &u, Acting acting)
{
  constexpr double near  = 1e-3; // of a large motion
  Eigen::VectorXd  acts  = Eigen::VectorXd::Ones(u.size());
  int              first = 0;
  for (const ElementPlacement &placement : machine.model().elements())
  {
    const int k = placement.element->n_measures();
    if (acting == Acting::structure && !placement.element->ideal_joint() &&
        !is_structure(*placement.element, u.segment(first, k), near * measure_size(machine.model(), placement)))
      acts.segment(first, k).setZero();
    first += k;
  }
  return acts;
}

Eigen::MatrixXd geometric_stiffness(const Machine &machine, const LocalState &state, Acting acting)
{
  Eigen::MatrixXd       local = geometric_of_measures(machine, state);
  const Eigen::VectorXd acts  = acting_measures(machine, state.u, acting);
  local                       = acts.asDiagonal() * local * acts.asDiagonal();
  const auto &W               = machine.forces().directions();
  return W * local * W.transpose();
}

Eigen::MatrixXd joint_jacobian(const Machine &machine, const ConstraintJacobian &G)
{
  // Relative to a unit translation, or to a lever of the size of the joint's positions: a sum of several such terms.
  constexpr double rounding = 64. * std::numeric_limits<double>::epsilon();
  Eigen::MatrixXd  rows(G.n_rows(), machine.size());
  G.times(Eigen::MatrixXd(machine.forces().directions().transpose()), rows);
  for (const ConstraintBlock &block : G.blocks())
    for (int row = block.first_row; row < block.first_row + block.n_rows; ++row)
      if (rows.row(row).norm() <= rounding * std::max(1., block.size))
        rows.row(row).setZero();
  return rows;
}

Eigen::MatrixXd free_motions(const Machine &machine, const LocalState &state, const std::vector<int> &fixed)
{
  const int n = machine.size(), n_c = machine.joints().n_rows(), n_f = int(fixed.size());
  if (n_c + n_f == 0)
    return Eigen::MatrixXd::Identity(n, n);
  ConstraintJacobian G(machine.joints().blocks());
  Eigen::VectorXd    g(n_c);
  machine.joints().constraints(state, g, G);
  Eigen::MatrixXd held(n_c + n_f, n);
  held.topRows(n_c) = joint_jacobian(machine, G);
  held.bottomRows(n_f).setZero();
  for (int i = 0; i < n_f; ++i)
    held(n_c + i, fixed[i]) = 1.;
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(held.transpose());
  const Eigen::MatrixXd                       Q = qr.householderQ();
  return Q.rightCols(n - qr.rank());
}

} // namespace gestell::coupling
