#include "apps/scene/build/superposed_machine.h"

#include "coupling/algebra/dense_modes.h"
#include "coupling/equilibrium/static_equilibrium.h"
#include "coupling/machine/configuration/dense_matrices.h"

#include <cmath>
#include <sstream>
#include <stdexcept>

namespace gestell::apps
{

namespace
{

constexpr double kept_off_limit = 0.95; ///< share of 2 / omega_max
constexpr double step_by_itself = 0.25; ///< of it: the period of the highest mode is right to 1 %
constexpr double worth_a_note   = 0.02; ///< share of the kinetic energy of a start

Eigen::MatrixXd mass_projection(const coupling::Machine &machine, const Eigen::MatrixXd &V)
{
  Eigen::MatrixXd projection(V.cols(), V.rows());
  Eigen::VectorXd column(V.rows());
  for (Eigen::Index j = 0; j < V.cols(); ++j)
  {
    machine.linear().mass_times(V.col(j), column);
    projection.row(j) = column.transpose();
  }
  return projection;
}

/// A start whose rotors turn is no vibration about a position.
void refuse_turning(const Scene &scene)
{
  if (scene.start.rule != StartRule::steady)
    return;
  for (const auto &[rotor, speed] : scene.start.steady.speeds)
    if (speed != 0.)
      throw std::invalid_argument(scene.start.place + ": \"" + rotor +
                                  "\" turns, and method = \"modal\" superposes vibrations about a position; take "
                                  "method = \"craig-bampton\"");
}

double stability_limit(const coupling::Machine &machine)
{
  Eigen::MatrixXd K, D;
  coupling::stiffest_matrices(machine, Eigen::VectorXd::Zero(machine.size()), K, D);
  const auto modes = coupling::dense_modes(coupling::dense_stiffness(machine) + K, coupling::dense_mass(machine));
  return 2. / modes.omega.maxCoeff();
}

/// What the modes do not carry of the motion at the start; empty: little.
std::string lost_motion(const coupling::Machine &whole, const Eigen::VectorXd &v, const Eigen::VectorXd &in_modes)
{
  Eigen::VectorXd momentum(v.size());
  whole.linear().mass_times(v, momentum);
  const double energy = v.dot(momentum), lost = energy - in_modes.squaredNorm();
  if (!(lost > worth_a_note * energy))
    return "";
  std::ostringstream text;
  text.precision(2);
  text << "modal superposition: the modes kept carry " << 100. * (1. - lost / energy)
       << " % of the kinetic energy of the start; give more modes";
  return text.str();
}

} // namespace

SuperposedMachine superposed(const Scene &scene, const coupling::Machine &whole, const Eigen::VectorXd &q)
{
  coupling::SuperpositionOptions options = *scene.reduction.superposition;
  options.open                           = scene.modes.open;
  coupling::Superposition found          = coupling::superpose(whole, q, options);
  SuperposedMachine       result{whole.in_modes(found.modes), {}, {}, 0., found.statements, found.notes};
  result.projection   = mass_projection(whole, found.modes.V);
  result.V            = std::move(found.modes.V);
  result.largest_step = stability_limit(result.machine);
  return result;
}

coupling::InitialState start_in_modes(const Scene &scene, coupling::Machine &machine, const coupling::Machine &whole,
                                      const Eigen::MatrixXd &projection, const coupling::InitialState &start)
{
  refuse_turning(scene);
  coupling::InitialState state = start;
  state.q                      = projection * start.q;
  state.v                      = projection * start.v;
  if (const std::string text = lost_motion(whole, start.v, state.v); !text.empty())
    state.notes.push_back(text);
  if (scene.start.rule == StartRule::rest)
    state.q = coupling::static_equilibrium(machine, state, coupling::Drift::none).q;
  return state;
}

std::string keep_stable_step(double largest, RunRequest &run)
{
  coupling::MethodOptions &method = run.options.method;
  if (method.method != "central-difference")
    return "";
  if (!run.step_given)
  {
    method.step = step_by_itself * largest;
    return "";
  }
  if (method.step <= kept_off_limit * largest)
    return "";
  std::ostringstream text;
  text << "run.step is " << method.step << " s, but central differences are stable up to 2 / omega_max = " << largest
       << " s of the modes kept; " << kept_off_limit * largest << " s is taken";
  method.step = kept_off_limit * largest;
  return text.str();
}

} // namespace gestell::apps
