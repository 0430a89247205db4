#include "coupling/dense_matrices.h"

#include "coupling/nearest_name.h"

#include <Eigen/QR>

#include <algorithm>

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
  return columns(machine.size(), [&](const Eigen::VectorXd &x, Eigen::VectorXd &y) { machine.mass_times(x, y); });
}

Eigen::MatrixXd dense_damping(const Machine &machine)
{
  return columns(machine.size(), [&](const Eigen::VectorXd &x, Eigen::VectorXd &y) { machine.damping_times(x, y); });
}

Eigen::MatrixXd dense_stiffness(const Machine &machine)
{
  return columns(machine.size(), [&](const Eigen::VectorXd &x, Eigen::VectorXd &y) { machine.stiffness_times(x, y); });
}

namespace
{

template <typename Matrices>
void add_up(const Machine &machine, const Eigen::VectorXd &q, Eigen::MatrixXd &stiffness, Eigen::MatrixXd &damping,
            const Matrices &of_element)
{
  const int             n = machine.size();
  const auto           &W = machine.directions();
  const Eigen::VectorXd u = W.transpose() * q;
  stiffness.setZero(n, n);
  damping.setZero(n, n);
  int first = 0;
  for (const ElementPlacement &placement : machine.elements())
  {
    const int       k = placement.element->n_measures();
    Eigen::MatrixXd K = Eigen::MatrixXd::Zero(k, k), D = K;
    of_element(placement, u.data() + first, K, D);
    const Eigen::MatrixXd own = W.middleCols(first, k);
    stiffness += own * K * own.transpose();
    damping += own * D * own.transpose();
    first += k;
  }
}

} // namespace

void engaged_matrices(const Machine &machine, const Eigen::VectorXd &q, const std::vector<std::string> &open,
                      Eigen::MatrixXd &stiffness, Eigen::MatrixXd &damping)
{
  std::vector<std::string> names;
  for (const ElementPlacement &placement : machine.elements())
    names.push_back(placement.name);
  for (const std::string &name : open)
    if (std::find(names.begin(), names.end(), name) == names.end())
      throw std::invalid_argument("modes: there is no element \"" + name + "\" to be open" + suggestion(name, names));
  add_up(machine, q, stiffness, damping,
         [&open](const ElementPlacement &placement, const double *u, Eigen::MatrixXd &K, Eigen::MatrixXd &D)
         {
           if (std::find(open.begin(), open.end(), placement.name) == open.end())
             placement.element->engaged(u, K.data(), D.data());
         });
}

void stiffest_matrices(const Machine &machine, const Eigen::VectorXd &q, Eigen::MatrixXd &stiffness,
                       Eigen::MatrixXd &damping)
{
  add_up(machine, q, stiffness, damping,
         [](const ElementPlacement &placement, const double *u, Eigen::MatrixXd &K, Eigen::MatrixXd &D)
         { placement.element->stiffest(u, K.data(), D.data()); });
}

Eigen::MatrixXd geometric_stiffness(const Machine &machine, const LocalState &state)
{
  Eigen::MatrixXd local;
  machine.geometric(state, local);
  const auto &W = machine.directions();
  return W * local * W.transpose();
}

Eigen::MatrixXd joint_jacobian(const Machine &machine, const ConstraintJacobian &G)
{
  Eigen::MatrixXd rows(G.n_rows(), machine.size());
  G.times(Eigen::MatrixXd(machine.directions().transpose()), rows);
  return rows;
}

Eigen::MatrixXd free_motions(const Machine &machine, const LocalState &state)
{
  const int          n = machine.size(), n_c = machine.n_constraints();
  ConstraintJacobian G(machine.constraint_blocks());
  Eigen::VectorXd    g(n_c);
  machine.constraints(state, g, G);
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(joint_jacobian(machine, G).transpose());
  const Eigen::MatrixXd                       Q = qr.householderQ();
  return Q.rightCols(n - qr.rank());
}

} // namespace gestell::coupling
