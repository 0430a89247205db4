#include "apps/scene/build/superposed_machine.h"

#include "coupling/algebra/dense_modes.h"
#include "coupling/equilibrium/static_equilibrium.h"
#include "coupling/machine/configuration/dense_matrices.h"

#include <algorithm>
#include <sstream>
#include <stdexcept>
#include <tuple>

namespace gestell::apps
{

namespace
{

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

/// [s] 2 / omega_max with all elements in the stiffest branch of their laws, and 1 / lambda_max of the dampers that act
/// there, p' = -lambda p.
std::pair<double, double> largest_steps(const coupling::Machine &machine)
{
  Eigen::MatrixXd K, D;
  coupling::stiffest_matrices(machine, Eigen::VectorXd::Zero(machine.size()), K, D);
  const Eigen::MatrixXd M     = coupling::dense_mass(machine);
  const auto            modes = coupling::dense_modes(coupling::dense_stiffness(machine) + K, M);
  const Eigen::MatrixXd B     = coupling::dense_damping(machine) + D;
  const double          decay = coupling::dense_modes(0.5 * (B + B.transpose()), M).omega.maxCoeff(); // sqrt(lambda)
  return {2. / modes.omega.maxCoeff(), 1. / (decay * decay)};
}

/// Share of an initial energy that the modes do not represent, as text; empty if it is small.
std::string lost(const std::string &energy, double whole, double in_modes)
{
  constexpr double worth_a_note = 0.02; // share of the energy of a start: 1 % of its amplitudes
  if (!(whole - in_modes > worth_a_note * whole))
    return "";
  std::ostringstream text;
  text.precision(2);
  text << "modal superposition: the retained modes carry " << 100. * std::max(0., in_modes / whole) << " % of the "
       << energy << " energy of the given initial state, which is changed accordingly; use more modes";
  return text.str();
}

/// What signals of forces within the frame lack in a machine in modes; empty: there are none.
std::string forces_in_modes(const Scene &scene)
{
  std::string names;
  for (const SignalRequest &signal : scene.signals)
    for (const char *family : {".support.", ".cut.", ".joint."})
      if (signal.path.rfind("frame.", 0) == 0 && signal.path.find(family) != std::string::npos)
        names += (names.empty() ? "" : ", ") + signal.name;
  return names.empty() ? ""
                       : "modal superposition: forces of supports, cuts and joints of the frame (" + names +
                             ") contain only the statics of the retained modes and need many more of them than "
                             "deflections do; method = \"craig-bampton\" contains the statics of all";
}

double energy_of(const coupling::Machine &machine, const Eigen::VectorXd &x, bool kinetic)
{
  Eigen::VectorXd product(x.size());
  if (kinetic)
    machine.linear().mass_times(x, product);
  else
    machine.linear().stiffness_times(x, product);
  return x.dot(product);
}

} // namespace

void refuse_turning(const Scene &scene)
{
  if (scene.start.rule != StartRule::steady)
    return;
  for (const auto &[rotor, speed] : scene.start.steady.speeds)
    if (speed != 0.)
      throw std::invalid_argument(
          scene.start.place + ": \"" + rotor +
          "\" rotates, but method = \"modal\" superposes vibrations about a position; use method = \"craig-bampton\"");
}

SuperposedMachine superposed(const Scene &scene, const coupling::Machine &whole, const Eigen::VectorXd &q)
{
  coupling::SuperpositionOptions options = *scene.reduction.superposition;
  options.open                           = scene.modes.open;
  coupling::Superposition found          = coupling::superpose(whole, q, options);
  SuperposedMachine       result{whole.in_modes(found.modes), {}, {}, 0., 0., found.statements, found.notes};
  result.projection                                    = mass_projection(whole, found.modes.V);
  result.V                                             = std::move(found.modes.V);
  std::tie(result.largest_step, result.shortest_decay) = largest_steps(result.machine);
  if (const std::string text = forces_in_modes(scene); !text.empty())
    result.notes.push_back(text);
  return result;
}

coupling::InitialState start_in_modes(const Scene &scene, coupling::Machine &machine, const coupling::Machine &whole,
                                      const Eigen::MatrixXd &projection, const coupling::InitialState &start)
{
  refuse_turning(scene);
  coupling::InitialState state = start;
  state.q                      = projection * start.q;
  state.v                      = projection * start.v;
  if (scene.start.rule == StartRule::rest)
  {
    state.q = coupling::static_equilibrium(machine, state, coupling::Drift::none).q;
    return state;
  }
  for (const bool kinetic : {true, false})
  {
    const std::string text =
        lost(kinetic ? "kinetic" : "elastic", energy_of(whole, kinetic ? start.v : start.q, kinetic),
             energy_of(machine, kinetic ? state.v : state.q, kinetic));
    if (!text.empty())
      state.notes.push_back(text);
  }
  return state;
}

std::string keep_stable_step(double largest, double decay, RunRequest &run)
{
  coupling::MethodOptions &method = run.options.method;
  if (method.method != "central-difference")
    return "";
  std::ostringstream text;
  if (!run.step_given)
  {
    // of the largest step that is stable: the period of the highest mode is right to 1 %
    constexpr double step_by_itself = 0.25;
    method.step                     = std::min(step_by_itself * largest, decay);
    const double     steps          = (run.options.end - run.options.begin) / method.step;
    constexpr double many_steps     = 1e7; // minutes of steps even of small machines: no wish, but stiff modes
    if (steps > many_steps)
      text << "central differences take " << steps << " steps of " << method.step << " s, as the highest retained "
           << "mode requires; retain fewer modes, or use method = \"exact\"";
    return text.str();
  }
  constexpr double kept_off_limit = 0.95; // share of 2 / omega_max, at which explicit steps lose their stability
  if (method.step > kept_off_limit * largest)
  {
    text << "run.step is " << method.step << " s, but central differences are stable up to 2 / omega_max = " << largest
         << " s of the retained modes; " << kept_off_limit * largest << " s is used";
    method.step = kept_off_limit * largest;
  }
  else if (method.step > decay)
    text << "run.step is " << method.step << " s, but dampers damp motions within " << decay
         << " s, which central differences do not resolve with longer steps; use a smaller step, or method = \"exact\"";
  return text.str();
}

} // namespace gestell::apps
