#include "coupling/machine/configuration/sticking_conflict.h"

#include "coupling/machine/configuration/constraint_rank.h"
#include "coupling/machine/configuration/dense_matrices.h"

#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <vector>

namespace gestell::coupling
{

namespace
{

constexpr double dependent = 1e-10; ///< distance of a row of length one from the span of others: their rounding

/// Rows that constrain motions, each of length one, with their owners.
struct Holding
{
  Eigen::MatrixXd          rows; ///< [n x number], columns
  std::vector<std::string> names;

  void add(const Eigen::VectorXd &row, const std::string &name)
  {
    rows.conservativeResize(row.size(), rows.cols() + 1);
    rows.rightCols(1) = row;
    names.push_back(name);
  }

  /// Names of the owners of rows that combine to this row; empty: it is independent.
  std::vector<std::string> makers_of(const Eigen::VectorXd &row) const
  {
    std::vector<std::string> makers;
    if (rows.cols() == 0)
      return makers;
    const Eigen::VectorXd x = rows.colPivHouseholderQr().solve(row);
    if ((rows * x - row).norm() > dependent)
      return makers;
    for (Eigen::Index i = 0; i < x.size(); ++i)
      if (std::abs(x[i]) > used_part && std::find(makers.begin(), makers.end(), names[i]) == makers.end())
        makers.push_back(names[i]);
    return makers;
  }
};

std::string element_of(const Machine &machine, int measure)
{
  for (const ElementPlacement &placement : machine.model().elements())
    if (measure -= placement.element->n_measures(); measure < 0)
      return placement.name;
  return "";
}

Holding held_by_joints(const Machine &machine, const LocalState &local)
{
  Holding            holding;
  ConstraintJacobian G(machine.joints().blocks());
  Eigen::VectorXd    g = Eigen::VectorXd::Zero(G.n_rows());
  machine.joints().constraints(local, g, G);
  const Eigen::MatrixXd rows = joint_jacobian(machine, G);
  int                   row  = 0;
  for (const ElementPlacement &placement : machine.model().elements())
    for (int i = 0; i < n_constraints(*placement.element); ++i, ++row)
      if (const double size = rows.row(row).norm(); size > 0.)
        holding.add(rows.row(row).transpose() / size, placement.name);
  return holding;
}

std::string words_of(const Machine &machine, const std::string &element, const Eigen::VectorXd &row,
                     const std::vector<std::string> &others)
{
  Eigen::Index most = 0;
  row.cwiseAbs().maxCoeff(&most);
  std::string text = "\"" + element + "\" sticks at the start and constrains the motion of " +
                     machine.coordinate_name(int(most)) + ", which ";
  for (std::size_t i = 0; i < others.size(); ++i)
    text += (i == 0 ? "\"" : i + 1 == others.size() ? " and \"" : ", \"") + others[i] + "\"";
  return text + (others.size() == 1 ? " also constrains" : " also constrain") +
         ": how they share the force is undefined. Remove one of them, give it the type \"friction\", which "
         "creeps, put a spring between them, or start in motion";
}

} // namespace

StickingConflict sticking_conflict(Machine &machine, const InitialState &initial)
{
  LocalState local;
  local.resize(machine);
  machine.gather(initial.t, initial.q, initial.v, Eigen::VectorXd::Zero(machine.size()), local);
  machine.events().start(local);
  if (machine.forces().held().empty())
    return {};
  Holding holding = held_by_joints(machine, local);
  for (const HeldMeasure &held : machine.forces().held())
  {
    const std::string     element = element_of(machine, held.measure);
    const Eigen::VectorXd row     = Eigen::VectorXd(machine.forces().directions().col(held.measure)).normalized();
    const auto            others  = holding.makers_of(row);
    if (!others.empty())
      return {element, words_of(machine, element, row, others)};
    holding.add(row, element);
  }
  return {};
}

} // namespace gestell::coupling
