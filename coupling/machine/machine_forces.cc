#include "coupling/machine/machine_system.h"

#include <algorithm>
#include <cmath>

namespace gestell::coupling
{

// Forces of the elements and equations of the joints, each in its measures.

const Eigen::SparseMatrix<double> &MachineForces::directions() const
{
  return parts_.W;
}

void MachineForces::force(const LocalState &state, Eigen::VectorXd &p) const
{
  for (const auto &part : parts_.placed)
    if (!part.implied())
      part.law->force(part.motion(state, parts_.by_history), parts_.history_of(part), p.data() + part.first_measure);
}

void MachineForces::tangent(const LocalState &state, double w_u, double w_v, double w_a, Eigen::VectorXd &p,
                            Eigen::MatrixXd &dp) const
{
  dp.setZero();
  double block[MachineParts::max_measures * MachineParts::max_measures];
  for (const auto &part : parts_.placed)
  {
    if (part.implied())
      continue;
    part.law->tangent(part.motion(state, parts_.by_history), parts_.history_of(part), {w_u, w_v, w_a},
                      p.data() + part.first_measure, block);
    for (int j = 0; j < part.n_measures; ++j)
      for (int i = 0; i < part.n_measures; ++i)
        dp(part.first_measure + i, part.first_measure + j) = block[i + part.n_measures * j];
  }
}

void MachineForces::derivatives(const LocalState &state, Eigen::VectorXd &p, Eigen::MatrixXd &dp_du,
                                Eigen::MatrixXd &dp_dv) const
{
  double of_u[MachineParts::max_measures * MachineParts::max_measures],
      of_v[MachineParts::max_measures * MachineParts::max_measures];
  for (const auto &part : parts_.placed)
  {
    if (part.implied())
      continue;
    part.law->derivatives(part.motion(state, parts_.by_history), parts_.history_of(part), p.data() + part.first_measure,
                          of_u, of_v);
    for (int j = 0; j < part.n_measures; ++j)
      for (int i = 0; i < part.n_measures; ++i)
      {
        dp_du(part.first_measure + i, part.first_measure + j) = of_u[i + part.n_measures * j];
        dp_dv(part.first_measure + i, part.first_measure + j) = of_v[i + part.n_measures * j];
      }
  }
}

namespace
{
/// The rotation of an element's force takes its geometric stiffness from dp/du.
void add_turning_of(const MachineParts &parts, const MachineParts::PlacedElement &part, const LocalState &state,
                    Eigen::MatrixXd &dp_du)
{
  double K[MachineParts::max_measures * MachineParts::max_measures];
  mechanism::geometric(*part.element, part.motion(state, parts.by_history), parts.history_of(part), K);
  dp_du.block(part.first_measure, part.first_measure, part.n_measures, part.n_measures) -=
      Eigen::Map<const Eigen::MatrixXd>(K, part.n_measures, part.n_measures);
}
} // namespace

void MachineForces::add_turning(const LocalState &state, Eigen::MatrixXd &dp_du) const
{
  for (const auto &part : parts_.placed)
    if (!part.implied() && part.element->structure())
      add_turning_of(parts_, part, state, dp_du);
}

std::vector<ForceBlock> MachineForces::blocks() const
{
  return parts_.force_blocks;
}

void MachineForces::tangent_blocks(const LocalState &state, double w_u, double w_v, double w_a, Eigen::VectorXd &p,
                                   Eigen::VectorXd &blocks) const
{
  double *block = blocks.data();
  for (const auto &part : parts_.placed)
  {
    if (part.first_constraint >= 0)
      continue;
    const int size = part.n_measures * part.n_measures;
    if (part.holds)
      std::fill_n(block, size, 0.);
    else
      part.law->tangent(part.motion(state, parts_.by_history), parts_.history_of(part), {w_u, w_v, w_a},
                        p.data() + part.first_measure, block);
    block += size;
  }
}

const std::vector<HeldMeasure> &MachineForces::held() const
{
  return parts_.held;
}

std::string MachineForces::element_of(int measure) const
{
  for (const auto &part : parts_.placed)
    if (measure >= part.first_measure && measure < part.first_measure + part.n_measures)
      return part.name;
  return LocalForces::element_of(measure);
}

double MachineParts::held_rate(int measure) const
{
  for (const HeldMeasure &h : held)
    if (h.measure == measure)
      return h.rate;
  return 0.;
}

double MachineParts::prescribed_power(const PlacedElement &joint, const LocalState &state) const
{
  double rate[max_constraints], bias[max_constraints], power = 0.;
  joint.joint->constraint_rates(joint.motion(state, by_history), history_of(joint), rate, bias);
  for (int i = 0; i < joint.joint->n_constraints(); ++i)
    power -= state.lambda[joint.first_constraint + i] * rate[i];
  return power;
}

double MachineParts::taken_power(const PlacedElement &part, const LocalState &state) const
{
  const auto motion = part.motion(state, by_history);
  double     p[max_measures];
  part.law->force(motion, history_of(part), p);
  double taken = -part.law->stored_power(motion, history_of(part));
  for (int i = 0; i < part.n_motions; ++i)
    taken -= p[i] * motion.v[i];
  return taken;
}

bool MachineJoints::wants_multipliers() const
{
  const auto watches_joint = [&](const MachineParts::PlacedSwitch &own)
  { return own.signal.element >= 0 && parts_.placed[own.watched].tells_multipliers(own.signal.quantity); };
  // Friction in a joint sticks up to its limit, which follows from multipliers.
  const auto sticks_in_joint = [](const MachineParts::PlacedElement &part)
  { return part.holds && part.first_multiplier >= 0; };
  // The energy balance needs the power of a prescribed motion.
  const auto drives = [this](int joint) { return parts_.placed[joint].drives; };
  return parts_.reads_joints || std::any_of(parts_.placed.begin(), parts_.placed.end(), sticks_in_joint) ||
         std::any_of(parts_.joints.begin(), parts_.joints.end(), drives) ||
         std::any_of(parts_.switches.begin(), parts_.switches.end(), watches_joint);
}

std::string MachineJoints::name(int i) const
{
  for (const int joint : parts_.joints)
  {
    const auto &part = parts_.placed[joint];
    const int   row  = i - part.first_constraint;
    if (row >= 0 && row < part.joint->n_constraints())
      return "\"" + parts_.elements[joint].name + "\" (" + part.joint->constraint_name(row) + ")";
  }
  return IdealJoints::name(i);
}

bool MachineForces::need_multipliers() const
{
  return std::any_of(parts_.elements.begin(), parts_.elements.end(),
                     [](const ElementPlacement &placement) { return placement.joint >= 0; });
}

const std::vector<ConstraintBlock> &MachineJoints::blocks() const
{
  return parts_.joint_blocks;
}

bool MachineJoints::depends(std::size_t b, int r, int k) const
{
  return parts_.placed[parts_.joints[b]].joint->depends(r, k);
}

void MachineJoints::add_turning(const LocalState &state, Eigen::MatrixXd &dp_du) const
{
  for (const int joint : parts_.joints)
    add_turning_of(parts_, parts_.placed[joint], state, dp_du);
}

/// Bodies have several joints: their cosines and sines are computed once, except where a derivative moves one measure.
void MachineJoints::turn(const LocalState &state) const
{
  turns_.resize(1 + parts_.angles.size());
  for (std::size_t i = 0; i < parts_.angles.size(); ++i)
  {
    const double phi = state.u[parts_.angles[i]];
    turns_[1 + i]    = {std::cos(phi), std::sin(phi)};
  }
}

mechanism::LocalMotion MachineJoints::motion(const MachineParts::PlacedElement &part, const LocalState &state,
                                             mechanism::Turn *turns) const
{
  for (int body = 0; body < 2; ++body)
  {
    turns[body] = turns_[part.angles[body]];
    if (const double phi = state.u[part.angles_of_it[body]];
        part.angles[body] > 0 && phi != state.u[parts_.angles[part.angles[body] - 1]])
      turns[body] = {std::cos(phi), std::sin(phi)};
  }
  mechanism::LocalMotion motion = part.motion(state, parts_.by_history);
  motion.turns                  = turns;
  return motion;
}

void MachineJoints::constraints(const LocalState &state, Eigen::VectorXd &g, ConstraintJacobian &G) const
{
  turn(state);
  mechanism::Turn turns[2];
  for (std::size_t i = 0; i < parts_.joint_blocks.size(); ++i)
  {
    const auto &part = parts_.placed[parts_.joints[i]];
    part.joint->constraint(motion(part, state, turns), parts_.history_of(part), g.data() + part.first_constraint,
                           G[i].data());
  }
}

void MachineJoints::rates(const LocalState &state, Eigen::VectorXd &rate, Eigen::VectorXd &bias) const
{
  turn(state);
  mechanism::Turn turns[2];
  for (const int joint : parts_.joints)
  {
    const auto &part = parts_.placed[joint];
    part.joint->constraint_rates(motion(part, state, turns), parts_.history_of(part),
                                 rate.data() + part.first_constraint, bias.data() + part.first_constraint);
  }
}

} // namespace gestell::coupling
