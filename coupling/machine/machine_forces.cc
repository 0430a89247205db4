#include "coupling/machine/machine_parts.h"

#include <algorithm>

namespace gestell::coupling
{

// Forces of the elements and equations of the joints, each in its measures.

void Machine::local_force(const LocalState &state, Eigen::VectorXd &p) const
{
  for (const auto &part : parts_->placed)
    if (!part.implied())
      part.element->force(part.motion(state, parts_->by_history), parts_->history_of(part),
                          p.data() + part.first_measure);
}

void Machine::local_tangent(const LocalState &state, double w_u, double w_v, double w_a, Eigen::VectorXd &p,
                            Eigen::MatrixXd &dp) const
{
  dp.setZero();
  double block[Parts::max_measures * Parts::max_measures];
  for (const auto &part : parts_->placed)
  {
    if (part.implied())
      continue;
    part.element->tangent(part.motion(state, parts_->by_history), parts_->history_of(part), {w_u, w_v, w_a},
                          p.data() + part.first_measure, block);
    for (int j = 0; j < part.n_measures; ++j)
      for (int i = 0; i < part.n_measures; ++i)
        dp(part.first_measure + i, part.first_measure + j) = block[i + part.n_measures * j];
  }
}

void Machine::local_derivatives(const LocalState &state, Eigen::VectorXd &p, Eigen::MatrixXd &dp_du,
                                Eigen::MatrixXd &dp_dv) const
{
  double of_u[Parts::max_measures * Parts::max_measures], of_v[Parts::max_measures * Parts::max_measures];
  for (const auto &part : parts_->placed)
  {
    if (part.implied())
      continue;
    part.element->derivatives(part.motion(state, parts_->by_history), parts_->history_of(part),
                              p.data() + part.first_measure, of_u, of_v);
    for (int j = 0; j < part.n_measures; ++j)
      for (int i = 0; i < part.n_measures; ++i)
      {
        dp_du(part.first_measure + i, part.first_measure + j) = of_u[i + part.n_measures * j];
        dp_dv(part.first_measure + i, part.first_measure + j) = of_v[i + part.n_measures * j];
      }
  }
}

void Machine::geometric(const LocalState &state, Eigen::MatrixXd &K) const
{
  K.setZero(parts_->W.cols(), parts_->W.cols());
  double block[Parts::max_measures * Parts::max_measures];
  for (const auto &part : parts_->placed)
  {
    part.element->geometric(part.motion(state, parts_->by_history), parts_->history_of(part), block);
    K.block(part.first_measure, part.first_measure, part.n_measures, part.n_measures) =
        Eigen::Map<const Eigen::MatrixXd>(block, part.n_measures, part.n_measures);
  }
}

std::vector<ForceBlock> Machine::force_blocks() const
{
  return parts_->force_blocks;
}

void Machine::local_tangent_blocks(const LocalState &state, double w_u, double w_v, double w_a, Eigen::VectorXd &p,
                                   Eigen::VectorXd &blocks) const
{
  double *block = blocks.data();
  for (const auto &part : parts_->placed)
  {
    if (part.first_constraint >= 0)
      continue;
    const int size = part.n_measures * part.n_measures;
    if (part.holds)
      std::fill_n(block, size, 0.);
    else
      part.element->tangent(part.motion(state, parts_->by_history), parts_->history_of(part), {w_u, w_v, w_a},
                            p.data() + part.first_measure, block);
    block += size;
  }
}

const std::vector<HeldMeasure> &Machine::held() const
{
  return parts_->held;
}

double Machine::Parts::held_rate(int measure) const
{
  for (const HeldMeasure &h : held)
    if (h.measure == measure)
      return h.rate;
  return 0.;
}

double Machine::Parts::prescribed_power(const PlacedElement &joint, const LocalState &state) const
{
  double rate[max_constraints], bias[max_constraints], power = 0.;
  joint.element->constraint_rates(joint.motion(state, by_history), history_of(joint), rate, bias);
  for (int i = 0; i < joint.element->n_constraints(); ++i)
    power -= state.lambda[joint.first_constraint + i] * rate[i];
  return power;
}

double Machine::Parts::taken_power(const PlacedElement &part, const LocalState &state) const
{
  const auto motion = part.motion(state, by_history);
  double     p[max_measures];
  part.element->force(motion, history_of(part), p);
  double taken = -part.element->stored_power(motion, history_of(part));
  for (int i = 0; i < part.n_motions; ++i)
    taken -= p[i] * motion.v[i];
  return taken;
}

const std::vector<ConstraintBlock> &Machine::constraint_blocks() const
{
  return parts_->joint_blocks;
}

void Machine::constraints(const LocalState &state, Eigen::VectorXd &g, ConstraintJacobian &G) const
{
  for (std::size_t i = 0; i < parts_->joint_blocks.size(); ++i)
  {
    const auto &part = parts_->placed[parts_->joints[i]];
    part.element->constraint(part.motion(state, parts_->by_history), parts_->history_of(part),
                             g.data() + part.first_constraint, G[i].data());
  }
}

void Machine::constraint_rates(const LocalState &state, Eigen::VectorXd &rate, Eigen::VectorXd &bias) const
{
  for (const int joint : parts_->joints)
  {
    const auto &part = parts_->placed[joint];
    part.element->constraint_rates(part.motion(state, parts_->by_history), parts_->history_of(part),
                                   rate.data() + part.first_constraint, bias.data() + part.first_constraint);
  }
}

} // namespace gestell::coupling
