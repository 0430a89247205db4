#include "apps/analysis/life/life_load.h"

#include "apps/analysis/life/life_rules.h"
#include "apps/scene/file/scene_override.h"
#include "coupling/frame/stress_field.h"
#include "fem/values/number_text.h"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <stdexcept>

namespace gestell::apps
{
namespace
{

using coupling::ReducedFrame;

Eigen::MatrixXd states_between(const Scene &scene, const ReducedFrame &frame, const coupling::RunResult &run,
                               double begin, double end, std::vector<double> *times = nullptr)
{
  constexpr double rounding = 1e-9; // of the interval between states
  const double     slack    = rounding * scene.run.options.states.step;
  const auto      &grid     = run.states.grid;
  const auto       after    = [](const coupling::KeptState &state, double t) { return state.t < t; };
  const auto       first    = std::lower_bound(grid.begin(), grid.end(), begin - slack, after);
  const auto       last     = std::lower_bound(first, grid.end(), end + slack, after);
  Eigen::MatrixXd  states(frame.stress.mean.cols(), last - first);
  for (auto state = first; state != last; ++state)
  {
    states.col(state - first) = coupling::stress_state(frame.stress, state->q, scene.gravity);
    if (times)
      times->push_back(state->t);
  }
  return states;
}

/// @param place  of the request in the own scene, for messages
void add_run(const Scene &scene, const ReducedFrame &frame, const coupling::RunResult &run, const std::string &place,
             LifeLoad &load)
{
  const double          begin = std::max(run.from, scene.run.options.begin), end = scene.run.options.end;
  const Eigen::MatrixXd states = states_between(scene, frame, run, begin, end, &load.t);
  const Eigen::Index    n      = load.states.cols();
  if (states.cols() < 3)
    throw std::runtime_error(place + ": the run of " + scene.file + " has " +
                             count_text(std::size_t(states.cols()), "state") + " in " + short_text(end - begin) +
                             " s: no cycle can be counted; life.step must be shorter");
  load.states.conservativeResize(states.rows(), n + states.cols());
  load.states.rightCols(states.cols()) = states;
  load.sequence.blocks.push_back({n, n + states.cols(), 1.});
  load.windows.push_back(end - begin);
}

bool same_frame(const ReducedFrame &a, const ReducedFrame &b)
{
  return a.points == b.points && a.stress.mean.rows() == b.stress.mean.rows() &&
         a.stress.mean.cols() == b.stress.mean.cols() && a.stress.mean == b.stress.mean;
}

std::string frame_words(const ReducedFrame &frame)
{
  return count_text(frame.points.size(), "point") + ", " +
         count_text(std::size_t(frame.n_interface), "interface coordinate") + ", " +
         count_text(std::size_t(frame.M.rows() - frame.n_interface), "mode");
}

std::string differing_words(const ReducedFrame *there, const ReducedFrame &here)
{
  const std::string own = frame_words(here), other = there ? frame_words(*there) : "none";
  return other == own ? own + " as in this scene, but with other stresses: material or dimensions differ"
                      : other + ") from this scene (" + own;
}

const SceneNode *node_at(const SceneNode &root, const std::string &key)
{
  const SceneNode *node = &root;
  for (const std::string &segment : key_segments(key, root.place))
    node = node ? node->find(segment) : nullptr;
  return node;
}

/// Whether both scenes have the table of a key.
bool both_have_table(const SceneNode &a, const SceneNode &b, const std::string &key)
{
  const auto end = key.rfind('.');
  return end == std::string::npos || (node_at(a, key.substr(0, end)) && node_at(b, key.substr(0, end)));
}

/// Sets the changes of the own scene whose keys the block inherits from the same line, or that neither file has in the
/// same table.
void apply_changes_of(const Variant &own, Variant &block)
{
  if (own.changes.empty())
    return;
  const auto      path  = std::filesystem::absolute(own.path).lexically_normal(); // as that of the block
  const SceneNode file  = std::filesystem::exists(path) ? Variant::of_file(path.string()).root : SceneNode();
  const SceneNode other = block.root;
  for (const std::string &change : own.changes)
  {
    const std::string key  = parsed_override(change).first;
    const SceneNode  *here = node_at(file, key), *there = node_at(other, key);
    if (here && there ? here->place.text() == there->place.text() : here == there && both_have_table(file, other, key))
      block.set(change);
  }
}

/// Calls `compute` for a block; an error in its scene begins with the place that names it.
template <typename Compute>
auto of_block(const BlockRequest &block, const Compute &compute)
try
{
  return compute();
}
catch (const std::invalid_argument &error)
{
  throw std::invalid_argument(block.place + ": " + error.what());
}

Variant with_changes_of(const Variant &own, const BlockRequest &block)
{
  Variant variant = Variant::of_file(block.file, {}, own.scripts);
  apply_changes_of(own, variant);
  return variant;
}

/// Another scene on this frame, with the states and stresses that are needed here.
std::unique_ptr<Session> block_session(Session &own, const BlockRequest &block, const ReducedFrame &frame,
                                       const Integration &integration = {})
{
  Variant variant               = with_changes_of(own.variant(), block);
  Scene   scene                 = variant.scene();
  scene.frame.geometry.stress   = true;
  scene.run.options.states.step = own.scene().run.options.states.step;
  if (integration)
    integrate_by(integration, scene);
  auto other =
      std::make_unique<Session>(std::move(variant), std::move(scene), Watch{own.progress(), own.interruption()});
  other->check_run();
  const ReducedFrame *there = other->machine().machine.model().reduced_frame();
  if (!there || !same_frame(frame, *there))
    throw std::invalid_argument(block.file + ": has a different frame (" + differing_words(there, frame) +
                                "); let both extend the same scene without changing keys of the frame");
  return other;
}

void add_block(Session &own, const BlockRequest &block, const ReducedFrame &frame, const Integration &integration,
               LifeLoad &load)
{
  const auto   other  = of_block(block, [&] { return block_session(own, block, frame, integration); });
  const Result result = other->run();
  if (!result.run->failure.empty() || result.run->interrupted)
    throw std::runtime_error(block.place + ": the run of " + block.file + " did not finish: " + result.run->failure);
  add_run(other->scene(), frame, *result.run, block.place, load);
}

} // namespace

Variant block_variant(const Variant &own, const BlockRequest &block)
{
  return of_block(block, [&] { return with_changes_of(own, block); });
}

Scene block_scene(const Variant &own, const BlockRequest &block)
{
  return of_block(block, [&] { return with_changes_of(own, block).scene(); });
}

void weigh(LifeLoad &load, const Variant &own, const Scene &scene)
{
  const LifeRequest &life = *scene.life;
  load.sequence.residue   = residue_of(life);
  load.service = load.strokes = 0.;
  const auto weigh_run        = [&](std::size_t k, const LifeRequest *of, double repetitions)
  {
    load.sequence.blocks.at(k).repetitions = repetitions;
    load.service += repetitions * (of && of->period > 0. ? of->period : load.windows[k]);
    load.strokes += repetitions * (of ? of->strokes : 1.);
  };
  weigh_run(0, &life, life.repetitions);
  for (std::size_t k = 0; k < life.blocks.size(); ++k)
    weigh_run(k + 1, block_scene(own, life.blocks[k]).life.get(), life.blocks[k].repetitions);
}

void check_blocks(Session &session)
{
  for (const BlockRequest &block : session.scene().life->blocks)
    of_block(block, [&] { return block_session(session, block, *session.machine().machine.model().reduced_frame()); });
}

void integrate_by(const Integration &integration, Scene &scene)
{
  scene.run.options.method = integration(scene);
  scene.run.step_given     = true;
}

LifeLoad life_load(Session &session, const coupling::RunResult &run, const Integration &integration)
{
  const Scene        &scene = session.scene();
  const LifeRequest  &life  = *scene.life;
  const ReducedFrame &frame = *session.machine().machine.model().reduced_frame();
  LifeLoad            load;
  load.step = scene.run.options.states.step;
  add_run(scene, frame, run, life.place, load);
  const double begin = scene.run.options.begin, length = scene.run.options.end - run.from;

  if (run.from > begin && run.from - length >= begin - load.step)
    load.before = states_between(scene, frame, run, run.from - length, run.from);
  for (const BlockRequest &block : life.blocks)
    add_block(session, block, frame, integration, load);
  weigh(load, session.variant(), scene);
  return load;
}

LifeLoad thinned(const LifeLoad &load, const std::vector<std::int64_t> &chosen)
{
  LifeLoad thin;
  thin.sequence.residue = load.sequence.residue;
  thin.states.resize(load.states.rows(), Eigen::Index(chosen.size()));
  for (std::size_t k = 0; k < chosen.size(); ++k)
    thin.states.col(Eigen::Index(k)) = load.states.col(chosen[k]);
  for (const LoadBlock &block : load.sequence.blocks)
  {
    const auto first = std::lower_bound(chosen.begin(), chosen.end(), block.first);
    const auto end   = std::lower_bound(first, chosen.end(), block.end);
    thin.sequence.blocks.push_back({first - chosen.begin(), end - chosen.begin(), block.repetitions});
  }
  return thin;
}

} // namespace gestell::apps
