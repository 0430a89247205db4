#include "coupling/machine/configuration/constraint_rank.h"

#include "coupling/machine/configuration/dense_matrices.h"
#include "mechanism/joints/orthonormal_directors.h"

#include <algorithm>
#include <cmath>

namespace gestell::coupling
{

namespace
{

using mechanism::OrthonormalDirectors;

bool makes_rigid(const ElementPlacement &placement)
{
  return dynamic_cast<const OrthonormalDirectors *>(placement.element.get()) != nullptr;
}

bool is_torque(const std::string &equation)
{
  return equation.find("(m") != std::string::npos || equation.find("(torque") != std::string::npos;
}

void add_once(std::vector<std::string> &names, const std::string &name)
{
  if (!name.empty() && std::find(names.begin(), names.end(), name) == names.end())
    names.push_back(name);
}

std::string joined(const std::vector<std::string> &names)
{
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i)
    text += (i == 0 ? "" : i + 1 == names.size() ? " and " : ", ") + names[i];
  return text;
}

} // namespace

ConstraintRank::ConstraintRank(const Machine &machine, Eigen::MatrixXd rows) : machine_(machine), rows_(std::move(rows))
{
  if (rows_.rows() == 0)
    return;
  for (Eigen::Index i = 0; i < rows_.rows(); ++i)
    if (const double size = rows_.row(i).norm(); size > 0.)
      rows_.row(i) /= size;
  int first = 0; // bodies are rigid whatever the joints are: their rows are the longer ones and come first
  for (const ElementPlacement &placement : machine.model().elements())
  {
    const int n = n_constraints(*placement.element);
    if (makes_rigid(placement))
      rows_.middleRows(first, n) *= 2.;
    first += n;
  }
  constexpr double rank_threshold = 1e-10; // for pivots of unit rows, up to rounding of levers
  qr_.setThreshold(rank_threshold);
  qr_.compute(rows_.transpose());
  dependent_ = int(rows_.rows() - qr_.rank());
}

ConstraintRank ConstraintRank::at(const Machine &machine, double t, const Eigen::VectorXd &q)
{
  LocalState local;
  local.resize(machine);
  const Eigen::VectorXd at_rest = Eigen::VectorXd::Zero(machine.size());
  machine.gather(t, q, at_rest, at_rest, local);
  ConstraintJacobian G(machine.joints().blocks());
  Eigen::VectorXd    g = Eigen::VectorXd::Zero(G.n_rows());
  machine.joints().constraints(local, g, G);
  return {machine, joint_jacobian(machine, G)};
}

std::string ConstraintRank::joint_of(int row) const
{
  for (const ElementPlacement &placement : machine_.model().elements())
  {
    const int n = n_constraints(*placement.element);
    if (row < n)
      return makes_rigid(placement) ? "" : "\"" + placement.name + "\"";
    row -= n;
  }
  return "";
}

std::vector<std::string> ConstraintRank::bodies_of(int row) const
{
  std::vector<std::string> bodies;
  for (Eigen::Index i = 0; i < rows_.cols(); ++i)
  {
    if (!(std::abs(rows_(row, i)) > used_part))
      continue;
    std::string body = "the frame";
    for (const Body &candidate : machine_.model().bodies())
      if (i >= machine_.model().n_frame() && candidate.coordinate <= i)
        body = "\"" + candidate.name + "\"";
    add_once(bodies, body);
  }
  return bodies;
}

std::string ConstraintRank::dependence() const
{
  const int   rank  = int(qr_.rank());
  const auto &order = qr_.colsPermutation().indices();
  // Row order[rank + k] = sum over j of coefficients(j, k) times row order[j].
  const Eigen::MatrixXd coefficients = qr_.matrixR()
                                           .topLeftCorner(rank, rank)
                                           .template triangularView<Eigen::Upper>()
                                           .solve(qr_.matrixR().topRightCorner(rank, dependent_));
  std::vector<std::pair<int, std::string>> lines;
  bool                                     torques = false, forces = false;
  for (int k = 0; k < dependent_; ++k)
  {
    const int                row = order[rank + k];
    std::vector<std::string> joints;
    for (int j = 0; j < rank; ++j)
      if (std::abs(coefficients(j, k)) > used_part)
        add_once(joints, joint_of(order[j]));
    const std::string equation               = machine_.joints().name(row);
    (is_torque(equation) ? torques : forces) = true;
    lines.emplace_back(row, "\n  " + equation + ", which constrains " + joined(bodies_of(row)) + ", " +
                                (joints.empty() ? "constrains nothing that could move"
                                                : "follows from the equations of " + joined(joints)));
  }
  std::sort(lines.begin(), lines.end());
  std::string text = "the joints are redundant, or do not constrain the mechanism in this position; ";
  text += dependent_ == 1 ? "one equation is redundant:" : std::to_string(dependent_) + " equations are redundant:";
  for (const auto &line : lines)
    text += line.second;
  text += "\nRemove the redundant constraint: ";
  if (torques)
    text += "a spherical joint instead of a revolute or rigid one frees rotations, ";
  if (forces)
    text += "a cylindrical one instead of a revolute one frees a translation, an in-plane one instead of a prismatic "
            "one a translation and rotations; ";
  return text + "or make one of the joints compliant; or, if the cause is the position, start in another one";
}

std::string ConstraintRank::nearly_dependent() const
{
  const auto n = rows_.rows();
  if (n == 0 || n > rows_.cols())
    return "";
  const double     pivot     = std::abs(qr_.matrixR()(n - 1, n - 1));
  constexpr double near_dead = 0.03; // pivot: about the angle [rad] to the dead position
  return pivot < near_dead ? machine_.joints().name(qr_.colsPermutation().indices()[n - 1]) : "";
}

} // namespace gestell::coupling
