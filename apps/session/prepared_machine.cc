#include "apps/session/prepared_machine.h"

#include "apps/scene/build/carried_bodies.h"
#include "apps/scene/build/damping_text.h"
#include "apps/scene/build/far_places.h"
#include "apps/scene/build/free_bodies.h"
#include "apps/scene/build/scene_magnitudes.h"
#include "apps/scene/build/superposed_machine.h"
#include "apps/scene/read/frame/matrix_units.h"
#include "apps/session/commit.h"
#include "apps/session/forces/acting_forces.h"
#include "apps/version.h"
#include "coupling/equilibrium/static_expansion.h"
#include "coupling/modes/modes.h"
#include "coupling/plugin/frame_service_loader.h"
#include "coupling/plugin/mesh_service.h"
#include "coupling/substructures/parts_recipe.h"
#include "coupling/substructures/reduced_parts.h"
#include "fem/values/available_memory.h"
#include "fem/values/mesh_phase.h"

#include <algorithm>
#include <filesystem>
#include <stdexcept>

namespace gestell::apps
{

namespace
{

/// A frame made from geometry or given by matrices, with its reduced companion.
coupling::MeshService::Unreduced unreduced_frame(const Scene &scene, const coupling::Progress &progress)
{
  const coupling::ReductionOptions &options = scene.reduction.options;
  if (scene.frame.source == FrameSource::geometry)
    return coupling::mesh_service().assemble(scene.frame.geometry, options, progress);
  const fem::FrameMatrices &given = scene.frame.matrices;
  return {given, coupling::frame_service().reduce(given, options, progress)};
}
} // namespace

void tell(const coupling::Progress &progress, const std::string &phase, double share)
{
  if (progress)
    progress(phase, share);
}

coupling::Progress stoppable(coupling::Progress progress, const std::atomic<bool> *stop)
{
  return [progress = std::move(progress), stop](const std::string &phase, double share)
  {
    if (stop && *stop && fem::may_be_stopped(phase))
      throw std::runtime_error("interrupted while the frame was created (" + phase + ")");
    tell(progress, phase, share);
  };
}

coupling::FrameOrigin frame_origin(const Scene &scene)
{
  const coupling::ReductionOptions &options = scene.reduction.options;
  coupling::FrameOrigin             origin;
  origin.scene = std::filesystem::absolute(scene.file).lexically_normal().string();
  switch (scene.frame.source)
  {
  case FrameSource::geometry:
    origin.recipe = coupling::recipe_of(scene.frame.geometry, options);
    origin.source = scene.frame.geometry.cad;
    break;
  case FrameSource::parts:
    origin.recipe = coupling::recipe_of(scene.frame.parts, options);
    origin.source = std::to_string(scene.frame.parts.parts.size()) + " parts";
    break;
  default:
    origin.recipe = coupling::recipe_of(scene.frame.matrices, options);
    origin.source = "matrices";
  }
  return origin;
}

namespace
{
coupling::ReducedFrame made(const Scene &scene, const coupling::Progress &progress)
{
  const coupling::ReductionOptions &options = scene.reduction.options;
  switch (scene.frame.source)
  {
  case FrameSource::geometry:
    return coupling::mesh_service().reduce(scene.frame.geometry, options, progress);
  case FrameSource::parts:
    return reduced_frame_of_parts(scene.frame.parts, options, progress);
  default:
    return coupling::frame_service().reduce(scene.frame.matrices, options, progress);
  }
}
} // namespace

coupling::CachedFrame reduced_frame(const Scene &scene, const coupling::Progress &progress)
{
  return coupling::cached_or_made(frame_origin(scene), [&] { return made(scene, progress); });
}

namespace
{
void add_warnings(const Scene &scene, PreparedMachine &prepared)
{
  if (const coupling::ReducedFrame *frame = prepared.small().model().reduced_frame())
  {
    for (const std::string &note : frame->all_notes())
      prepared.warnings.push_back(note);
    if (scene.frame.source == FrameSource::matrices)
      if (const std::string suspicion = suspect_frequency(*frame); !suspicion.empty())
        prepared.warnings.push_back(suspicion);
  }
  prepared.warnings.insert(prepared.warnings.end(), scene.warnings.begin(), scene.warnings.end());
}

PreparedMachine on_full_frame(const Scene &scene, const coupling::Progress &progress)
{
  auto [frame, reduced]       = unreduced_frame(scene, progress);
  coupling::Machine companion = build_machine(scene, reduced);
  if (frame.modal_damping_ratio.any())
  {
    const int     n_reduced    = static_cast<int>(reduced.omega0.size());
    constexpr int damped_modes = 60; // Modes damped in an unreduced frame with modal damping, at least.
    coupling::frame_service().add_modal_damping(frame, std::max(damped_modes, n_reduced), progress,
                                                scene.reduction.options.factor);
  }
  return {build_machine(scene, std::move(frame)), std::move(companion), {}};
}

PreparedMachine without_warnings(const Scene &scene, const coupling::Progress &progress)
{
  switch (frame_path(scene))
  {
  case FramePath::none:
  case FramePath::dense:
    return {build_machine(scene), {}, {}};
  case FramePath::from_file:
    return {build_machine(scene, coupling::read_reduced_frame(scene.frame.reduced_file)), {}, {}};
  case FramePath::reduce:
    return {build_machine(scene, reduced_frame(scene, progress).frame), {}, {}};
  case FramePath::sparse:
    break;
  }
  return on_full_frame(scene, progress);
}

/// Configuration q of the whole machine for the modes.
Eigen::VectorXd whole_configuration(const Scene &scene, PreparedMachine &prepared)
{
  const Eigen::VectorXd q = modes_configuration(scene, prepared.small());
  if (!prepared.companion)
    return q;
  const coupling::InitialState at{scene.run.options.begin, q, Eigen::VectorXd::Zero(q.size())};
  return coupling::expand_statically(prepared.machine, *prepared.companion, at).q;
}

/// The same machine in the modes requested by the scene; the original becomes its companion, unless it has one.
PreparedMachine in_modes(const Scene &scene, PreparedMachine physical)
{
  SuperposedMachine modes  = superposed(scene, physical.machine, whole_configuration(scene, physical));
  auto              link   = std::make_shared<MachineInModes>();
  const bool        sparse = physical.companion.has_value();
  link->projection         = std::move(modes.projection);
  link->largest_step       = modes.largest_step;
  link->shortest_decay     = modes.shortest_decay;
  link->statements         = std::move(modes.statements);
  link->companion.resize(physical.small().size(), modes.V.cols());
  for (Eigen::Index j = 0; j < modes.V.cols(); ++j)
    link->companion.col(j) = sparse ? physical.project(modes.V.col(j)) : Eigen::VectorXd(modes.V.col(j));
  PreparedMachine result{std::move(modes.machine), std::move(physical.companion), std::move(modes.notes)};
  if (sparse)
    link->whole = std::move(physical.machine);
  else
    result.companion = std::move(physical.machine);
  result.in_modes = std::move(link);
  return result;
}

} // namespace

void keep_stable_step(PreparedMachine &prepared, RunRequest &run)
{
  if (!prepared.in_modes)
    return;
  if (const std::string text =
          keep_stable_step(prepared.in_modes->largest_step, prepared.in_modes->shortest_decay, run);
      !text.empty())
    prepared.warnings.push_back(text);
}

namespace
{

/// Adds superposition, if the scene requests it, and the warnings.
PreparedMachine finished(const Scene &scene, PreparedMachine prepared, const coupling::Progress &progress)
{
  if (scene.reduction.superposition)
  {
    tell(progress, "modes of the machine");
    prepared = in_modes(scene, std::move(prepared));
  }
  add_warnings(scene, prepared);
  return prepared;
}

} // namespace

PreparedMachine prepare_machine(const Scene &scene, const coupling::Progress &progress,
                                const coupling::ReducedFrame *on)
{
  if (on)
    return finished(scene, {build_machine(scene, *on), {}, {}}, progress);
  tell(progress, "frame");
  return finished(scene, without_warnings(scene, progress), progress);
}

Eigen::VectorXd PreparedMachine::project(const Eigen::VectorXd &state) const
{
  if (in_modes)
    return in_modes->companion * state;
  Eigen::VectorXd projected = Eigen::VectorXd::Zero(companion->size());
  const auto      n_bodies  = machine.model().n_mechanism();
  projected.tail(n_bodies)  = state.tail(n_bodies);
  for (const fem::Interface &interface : machine.model().full_frame()->interfaces)
    for (const fem::Interface &other : companion->model().reduced_frame()->interfaces)
      if (interface.name == other.name)
        for (int m = 0; m < 6; ++m)
          if (interface.coordinate[m] >= 0)
            projected[other.coordinate[m]] = state[interface.coordinate[m]];
  return projected;
}

coupling::InitialState prepare_start(const Scene &scene, PreparedMachine &prepared)
{
  const coupling::InitialState state = initial_state(scene, prepared.small());
  if (!prepared.in_modes)
    return prepared.companion ? coupling::expand_statically(prepared.machine, *prepared.companion, state) : state;
  const MachineInModes &modes = *prepared.in_modes;
  if (!modes.whole)
    return start_in_modes(scene, prepared.machine, *prepared.companion, modes.projection, state);
  return start_in_modes(scene, prepared.machine, *modes.whole, modes.projection,
                        coupling::expand_statically(*modes.whole, *prepared.companion, state));
}

std::string mesh_text(const FrameRequest &frame)
{
  return frame.source == FrameSource::matrices
             ? "the frame is given by matrices, so the error of the original mesh is unknown"
             : "";
}

ModelFacts model_facts(const PreparedMachine &prepared)
{
  ModelFacts facts;
  facts.dofs      = prepared.machine.size();
  facts.nonlinear = static_cast<int>(prepared.machine.forces().directions().cols());
  if (const coupling::ReducedFrame *frame = prepared.small().model().reduced_frame())
  {
    facts.interface  = frame->n_interface;
    const bool modes = frame->modal && !prepared.companion;
    facts.modes      = modes ? static_cast<int>(frame->M.rows()) - frame->n_interface : 0;
    facts.frame_dofs = frame->n_full > 0 ? frame->n_full : static_cast<int>(frame->M.rows());
    if (frame->n_cells > 0)
      facts.cells = frame->n_cells;
    if (frame->mass > 0.)
      facts.frame_mass = frame->mass;
    facts.frame        = frame->facts;
    facts.free_motions = static_cast<int>((frame->frequencies_hz.array() == 0.).count());
    facts.statements   = frame->statements;
    if (frame->frequency_limit_hz > 0.)
      facts.frequency_limit = frame->frequency_limit_hz;
    if (frame->omega0.size() > 0 && !prepared.companion)
    {
      facts.static_residual = frame->static_residual;
      for (Eigen::Index j = 0; j < frame->frequency_error.size(); ++j)
        if (frame->frequencies_hz[j] <= frame->frequency_limit_hz)
          facts.frequency_error = std::fmax(facts.frequency_error, frame->frequency_error[j]); // nan gives way
    }
  }
  if (prepared.in_modes)
  {
    facts.interface  = 0;
    facts.modes      = prepared.machine.size();
    facts.superposed = int(prepared.in_modes->projection.cols());
    facts.statements.insert(facts.statements.end(), prepared.in_modes->statements.begin(),
                            prepared.in_modes->statements.end());
  }
  return facts;
}

namespace
{

/// The machine with its drives at the speeds of its start.
void add_poles(const Scene &scene, coupling::Machine &machine, const Eigen::VectorXd &q,
               const coupling::Linearisation &how, Result &result)
{
  Eigen::VectorXd speeds = Eigen::VectorXd::Zero(machine.size());
  std::string     unknown;
  try
  {
    speeds = initial_state(scene, machine).v;
  }
  catch (const std::exception &error)
  {
    unknown = error.what();
  }
  result.poles = coupling::operating_poles(machine, q, speeds, scene.run.options.begin, how);
  if (!result.poles.empty() && !unknown.empty())
    result.warnings.push_back("drives are linearised at rest, because the initial speeds are unknown: " + unknown);
  if (result.poles.size() > std::size_t(scene.modes.number))
    result.poles.resize(scene.modes.number);
}

void add_modes(const Scene &scene, coupling::Machine &machine, const Eigen::VectorXd &q,
               const coupling::Linearisation &how, Result &result)
{
  result.modes_at      = q;
  result.coupled_modes = coupling::linearised_modes(machine, q, how, scene.modes.number);
  if (!result.coupled_modes.empty())
    result.energy_shares = coupling::energy_shares(machine, q, scene.modes.open, result.coupled_modes);
  add_poles(scene, machine, q, how, result);
}

/// Returns the message of a failure, or an empty string if the work was done.
template <typename Work>
std::string none_by(const Work &work)
{
  try
  {
    work();
    return "";
  }
  catch (const std::invalid_argument &none)
  {
    return none.what();
  }
  catch (const coupling::ConvergenceFailure &none)
  {
    return none.what();
  }
}

/// Modes in addition to another answer.  If a law has no stiffness in the configuration of the modes, they are computed
/// at the start; if that also fails, the answer has no modes.
void add_modes_beside(const Scene &scene, coupling::Machine &machine, const coupling::Linearisation &how,
                      Result &result)
{
  const Eigen::VectorXd q   = modes_configuration(scene, machine);
  const std::string     why = none_by([&] { add_modes(scene, machine, q, how, result); });
  if (why.empty())
    return;
  const std::string why_none =
      none_by([&] { add_modes(scene, machine, initial_state(scene, machine).q, how, result); });
  if (why_none.empty())
  {
    result.warnings.push_back(
        "the modes are those of the initial state, because they cannot be computed in the configuration of [modes]: " +
        why);
    return;
  }
  result.modes_at = q;
  result.coupled_modes.clear();
  result.energy_shares.reset();
  result.poles.clear();
  result.warnings.push_back("no modes are listed: " + why);
}

/// Why there are no modes; empty: there are.
/// @throws std::invalid_argument if there is not enough memory for them
std::string without_modes(const Scene &scene, const std::string &command, const coupling::Machine &machine)
{
  const int n = machine.size();
  if (scene.modes.number == 0 && command == "modes")
    throw std::invalid_argument("modes.number = 0 switches the modes off; use --set modes.number=20");
  if (scene.modes.number == 0)
    return "not requested";
  // Largest number of coordinates for which a run computes modes without a request: their cost grows with the third
  // power, that of a motion much less.
  constexpr int most_coordinates = 600;
  if (command == "run" && n > most_coordinates)
    return "with " + std::to_string(n) + " DOFs, more than " + std::to_string(most_coordinates) +
           ", modes take longer than most runs (cost: third power of the number); `gestell modes` computes them, and "
           "modes.number = 0 removes this note";
  // Number of dense matrices [n x n] allocated at once for the modes of n coordinates: M, B, K, Z, those of the free
  // motions, the modes, and the state matrix [2n x 2n] with its complex vectors.
  constexpr double matrices_of_modes = 24.;
  fem::require_available("modes: dense matrices of " + std::to_string(n) + " DOFs", matrices_of_modes * 8. * n * n,
                         "Set modes.number = 0 for no modes, or use fewer bodies.");
  return "";
}

} // namespace

Result begin_result(const Scene &scene, const std::string &command, PreparedMachine &prepared,
                    coupling::GeometricStiffness geometric)
{
  coupling::Machine &small = prepared.small();
  Result             result;
  result.scene              = scene.name;
  result.description        = scene.description;
  result.version            = version;
  result.commit             = commit();
  result.command            = command;
  result.model              = model_facts(prepared);
  result.model.damping      = damping_text(scene.frame);
  result.model.mesh         = mesh_text(scene.frame);
  const std::string without = without_modes(scene, command, small);
  if (without.empty())
    result.frame_modes = coupling::frame_modes(small, scene.modes.number);
  for (int i = 0; i < small.size(); ++i)
    result.coordinate_names.push_back(small.coordinate_name(i));
  result.warnings = prepared.warnings;
  const coupling::Linearisation how{scene.modes.open, geometric};
  if (command == "modes")
    add_modes(scene, small, modes_configuration(scene, small), how, result);
  else if (without.empty())
    add_modes_beside(scene, small, how, result);
  else
    result.modes_at = modes_configuration(scene, small);
  for (const auto &warnings : {carried_warnings(scene, small.model()), idle_bodies(scene, small.model()),
                               remote_joints(scene, small.model()), places_far_from_faces(scene, small.model())})
    result.warnings.insert(result.warnings.end(), warnings.begin(), warnings.end());
  auto       unexpected = scene_magnitudes(scene, small, Masses::known);
  const auto of_modes   = magnitudes_of_modes(scene, result.frame_modes);
  unexpected.insert(unexpected.end(), of_modes.begin(), of_modes.end());
  warn_of_magnitudes(std::move(unexpected), result.warnings);
  if (const auto warning = free_frame(scene, small.model(), result.coupled_modes); command == "run" && !warning.empty())
    result.warnings.push_back(warning);
  if (!without.empty() && scene.modes.number > 0)
    result.warnings.push_back(without);
  result.scenery        = scenery_of(small);
  result.scenery.forces = forces_in_space(scene, small);
  for (const BodyRequest &body : scene.bodies)
    if (body.part)
    {
      result.bodies_from_cad.push_back(body.part->found);
      if (!body.part->shape.points.empty())
        result.scenery.parts.push_back({body.name, body.part->shape.points, body.part->shape.triangles});
    }
  return result;
}

} // namespace gestell::apps
