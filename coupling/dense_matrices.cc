#include "coupling/dense_matrices.h"

#include "coupling/nearest_name.h"

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

void engaged_matrices(const Machine &machine, const Eigen::VectorXd &q, const std::vector<std::string> &open,
                      Eigen::MatrixXd &stiffness, Eigen::MatrixXd &damping)
{
  std::vector<std::string> names;
  for (const ElementPlacement &placement : machine.elements())
    names.push_back(placement.name);
  for (const std::string &name : open)
    if (std::find(names.begin(), names.end(), name) == names.end())
      throw std::invalid_argument("modes: there is no element \"" + name + "\" to be open" + suggestion(name, names));

  const int             n = machine.size();
  const auto           &W = machine.directions();
  const Eigen::VectorXd u = W.transpose() * q;
  stiffness.setZero(n, n);
  damping.setZero(n, n);
  int first = 0;
  for (const ElementPlacement &placement : machine.elements())
  {
    const int       k = placement.element->n_measures();
    Eigen::MatrixXd K(k, k), D(k, k);
    placement.element->engaged(u.data() + first, K.data(), D.data());
    if (std::find(open.begin(), open.end(), placement.name) == open.end())
    {
      const Eigen::MatrixXd own = W.middleCols(first, k);
      stiffness += own * K * own.transpose();
      damping += own * D * own.transpose();
    }
    first += k;
  }
}

} // namespace gestell::coupling
