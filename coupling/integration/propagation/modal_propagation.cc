#include "coupling/integration/propagation/modal_propagation.h"

#include "coupling/integration/step/consistent_start.h"
#include "coupling/integration/system/acceleration_forces.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace gestell::coupling
{

namespace
{
constexpr double safety = 0.5; ///< a step is doubled if its error, scaled to it, stays below this

/// Frequency or decay rate of a block [1/s].
double rate_of(const ModalBlock &block)
{
  return block.kind == ModalBlock::free ? 0. : std::max(std::abs(block.s), std::abs(block.w));
}

/// Initial step, which is the largest one: an eighth of the longest period of the base system.  Without a period, 10
/// ms: few steps for a run of unconstrained bodies, and the error control halves it as often as necessary.
double natural_step(const ModalBlocks &modes)
{
  double slowest = 0.;
  for (int b = 0; b < modes.n_modal; ++b)
    if (modes.blocks[b].kind == ModalBlock::oscillating && (slowest == 0. || modes.blocks[b].w < slowest))
      slowest = modes.blocks[b].w;
  return slowest > 0. ? 0.125 * 6.283185307179586 / slowest : 1e-2;
}
} // namespace

ModalPropagation::ModalPropagation(const SecondOrderSystem &system, const Options &options)
    : system_(system), options_(options), modes_(modal_blocks(system, options.modes.get())),
      context_(system, modes_, options.newton)
{
  const auto n_u = system.forces().directions().cols();
  force_         = options.force == ForceRule::collocation ? make_collocation_step(context_, options.order / 2)
                                                           : make_fused_step(context_, options.force);
  Q_             = reordered(modes_.Q, context_.measures.n_p);
  V_             = reordered(modes_.V, context_.measures.n_p);
  context_.error_tolerance = options.tolerance;
  for (const ModalBlock &block : context_.measures.blocks)
    fastest_ = std::max(fastest_, rate_of(block));
  step_ = options.step > 0. ? options.step : natural_step(modes_);
  local_.resize(system);
  local_begin_.resize(system);
  held_.resize(system);
  for (Eigen::VectorXd *x : {&x_, &x_work_, &x_inside_})
    x->setZero(2 * context_.measures.n_p);
  forces_.setZero(force_->basis().size() * n_u);
  now_.local.resize(system);
}

void ModalPropagation::begin(double t, const Eigen::VectorXd &q, const Eigen::VectorXd &v)
{
  x_                 = reordered(modes_.state(t, q, v).transpose(), context_.measures.n_p).transpose();
  local_.t           = t;
  local_.u.noalias() = system_.forces().directions().transpose() * q;
  local_.v.noalias() = system_.forces().directions().transpose() * v;
  local_.p.setZero();
  refuse_accelerations();
  context_.begin(x_, local_.u);
  t_origin_ = t;
  tick_     = 0;
  on_grid_  = true;
  rung_     = 0;
  start_piece();
}

/// Once: whether a law depends on u'' does not change with the motion.
void ModalPropagation::refuse_accelerations()
{
  if (context_.work.steps > 0 || local_.u.size() == 0)
    return;
  refuse_acceleration_forces(system_, local_, "exact propagation");
  ++context_.work.evaluations;
}

void ModalPropagation::expect(double way, double)
{
  context_.loads_way = way;
}

/// Harmonics of the load as they are at local_.t, in x_: what rounding did to them goes.
void ModalPropagation::turn_harmonics()
{
  for (std::size_t j = 0; j < modes_.harmonics.size(); ++j)
  {
    const auto b                  = modes_.n_modal + Eigen::Index(j);
    x_[b]                         = std::cos(modes_.harmonics[j] * local_.t);
    x_[context_.measures.n_p + b] = std::sin(modes_.harmonics[j] * local_.t);
  }
}

/// Forces and acceleration at x_; the first step from here knows no past.
void ModalPropagation::start_piece()
{
  t_begin_ = t_full_ = local_.t;
  last_error_        = options_.tolerance > 0. ? safety : 0.;
  stepped_ = cut_ = false;
  forget_inside();
  system_.forces().force(local_, local_.p);
  ++context_.work.evaluations;
  context_.accelerate(x_, local_);
  force_->begin(x_, local_);
  local_begin_ = local_;
}

void ModalPropagation::forget_inside()
{
  now_known_ = false;
  h_smooth_  = 0.;
  t_inside_  = t_begin_;
}

ModalPropagation::Target ModalPropagation::next_target() const
{
  Target target;
  int    rung = rung_;
  if (on_grid_)
  {
    while (tick_ % (int64_t(1) << (finest - rung)) != 0)
      ++rung;
    target.on_grid = true;
    target.tick    = tick_ + (int64_t(1) << (finest - rung));
    target.h       = spacing(rung);
  }
  else
  {
    const int64_t unit       = int64_t(1) << (finest - rung);
    target.tick              = (int64_t(std::floor((local_begin_.t - t_origin_) / spacing(rung))) + 1) * unit;
    const auto       time_of = [&](int64_t tick) { return t_origin_ + double(tick) * std::ldexp(step_, -finest); };
    constexpr double shortest_partial = 0.05; // of a step: a shorter way to the grid is joined with the next step
    if (time_of(target.tick) - local_begin_.t < shortest_partial * spacing(rung))
      target.tick += unit;
    target.h = time_of(target.tick) - local_begin_.t;
  }
  target.t    = t_origin_ + double(target.tick) * std::ldexp(step_, -finest);
  target.rung = rung;
  return target;
}

const StepTable &ModalPropagation::table_for(const Target &target)
{
  if (target.on_grid)
  {
    StepTable &table = tables_[target.rung];
    if (table.h != target.h)
    {
      table.fill(context_.measures, force_->basis(), target.h);
      ++context_.work.factorisations;
    }
    return table;
  }
  if (partial_.h != target.h)
  {
    partial_.fill(context_.measures, force_->basis(), target.h);
    ++context_.work.factorisations;
  }
  return partial_;
}

bool ModalPropagation::attempt(const Target &target)
{
  ++context_.work.solves;
  try
  {
    return force_->solve(table_for(target), local_);
  }
  catch (const ConvergenceFailure &)
  {
    local_ = local_begin_;
    throw;
  }
}

void ModalPropagation::advance()
{
  if (cut_)
    restart();
  if (stepped_)
  {
    force_->accept();
    tick_        = target_.tick;
    on_grid_     = true;
    local_begin_ = local_;
    t_begin_     = local_.t;
    stepped_     = false;
  }
  forget_inside();
  for (;;)
  {
    const Target target = next_target();
    const bool   solved = attempt(target);
    const double error  = solved && options_.tolerance > 0. ? force_->error() / options_.tolerance : 0.;
    if (solved && error <= 1.)
    {
      target_  = target;
      local_.t = t_full_ = target.t;
      stepped_           = true;
      ++context_.work.steps;
      // For two steps: if steps are too long for the motion one error may be small by coincidence.
      const double grown = std::max(error, last_error_) * std::ldexp(1., force_->error_order());
      last_error_        = error;
      if (rung_ > 0 && grown < safety)
      {
        --rung_;
        last_error_ = safety;
      }
      return;
    }
    ++context_.work.rejected;
    if (rung_ >= options_.max_halvings || rung_ + 1 >= finest)
    {
      local_ = local_begin_;
      fail(solved ? "the local error stays above the tolerance" : "Newton's method did not converge");
    }
    rung_ = std::max(rung_, target.rung) + 1;
  }
}

void ModalPropagation::cut(double t)
{
  forget_inside();
  cut_ = true;
  if (!(t > t_begin_))
  {
    local_ = local_begin_;
    return;
  }
  Target target;
  target.h = t - t_begin_;
  if (attempt(target))
  {
    local_.t = t;
    keep_held_rates(system_, local_.v);
    return;
  }
  ++context_.work.rejected;
  local_ = local_begin_;
  if (++rung_ > options_.max_halvings)
    fail("Newton's method did not converge in the step to an event");
}

void ModalPropagation::restart()
{
  if (cut_ && local_.t > t_begin_)
    force_->end_state(x_);
  else if (cut_ || !stepped_)
    force_->begin_state(x_);
  else
    force_->end_state(x_);
  if (cut_)
    on_grid_ = on_grid_ && local_.t == t_begin_;
  else if (stepped_)
  {
    tick_    = target_.tick;
    on_grid_ = true;
  }
  turn_harmonics();
  start_piece();
}

const Instant &ModalPropagation::instant() const
{
  if (!now_known_)
  {
    const Eigen::VectorXd &x = state_at(local_.t);
    now_.t                   = local_.t;
    now_.q.noalias()         = Q_ * x;
    now_.v.noalias()         = V_ * x;
    now_.local               = local_;
    now_known_               = true;
  }
  return now_;
}

void ModalPropagation::interpolate(double t, LocalState &state) const
{
  const double h = local_.t - t_begin_;
  if (!(h > 0.))
  {
    state   = local_;
    state.t = t;
    return;
  }
  force_->interpolate((t - t_begin_) / h, state);
  state.t = t;
  // of a step: over a shorter one u moves too little for its rate to be read
  constexpr double few_differences = 1e-3;
  const bool       is_read = h < few_differences * step_ || !is_smooth(h), holds = !system_.forces().held().empty();
  if (!is_read && !holds)
    return;
  const Eigen::VectorXd &x = state_at(t);
  if (is_read)
  {
    state.u.noalias() = context_.measures.read_u.transpose() * x;
    state.v.noalias() = context_.measures.read_v.transpose() * x;
  }
  if (!holds)
    return;
  keep_held_rates(system_, state.v);
  system_.forces().force(state, state.p);
  ++context_.work.evaluations;
  context_.accelerate(x, state);
}

/// Whether the interpolation of the measures over the last step is as accurate as their integration: modes with a large
/// phase per step move the measures little compared with their largest excursions.
bool ModalPropagation::is_smooth(double h) const
{
  if (h_smooth_ == h)
    return smooth_;
  h_smooth_                         = h;
  smooth_                           = true;
  constexpr double     of_tolerance = 0.1, of_fixed = 1e-6; // share of the excursions by which dense output may err
  const double         share      = options_.tolerance > 0. ? of_tolerance * options_.tolerance : of_fixed;
  const ModalMeasures &measures   = context_.measures;
  constexpr double     negligible = 1e-14; // error of the forces' interpolation, relative
  if (force_->interpolation_error(h * fastest_) < negligible)
    return smooth_;
  force_->end_state(x_work_);
  for (int b = 0; b < measures.n_p && smooth_; ++b)
  {
    const double error = force_->interpolation_error(h * rate_of(measures.blocks[b]));
    if (error < negligible)
      continue;
    for (const int row : {b, measures.n_p + b})
      smooth_ = smooth_ && (error * std::abs(x_work_[row]) * measures.read_u.row(row).cwiseAbs().transpose().array() <=
                            share * context_.scale.array())
                               .all();
  }
  return smooth_;
}

/// From the modes that move a measure by more than a small share of its largest excursion, at the start of the step or
/// at its end, for any phase.
int ModalPropagation::parts_of_step() const
{
  const double         h             = local_.t - t_begin_;
  const ModalMeasures &measures      = context_.measures;
  constexpr double     furthest_turn = 3.2; // [rad] of what moves a measure within a part of a step
  double               most          = furthest_turn;
  if (!(h * fastest_ > most))
    return 1;
  for (const bool at_end : {false, true})
  {
    if (at_end)
      force_->end_state(x_work_);
    else
      force_->begin_state(x_work_);
    for (int b = 0; b < measures.n_p; ++b)
    {
      const double rate = rate_of(measures.blocks[b]);
      if (!(h * rate > most))
        continue;
      const double x_1 = std::abs(x_work_[b]), x_2 = std::abs(x_work_[measures.n_p + b]);
      const auto   moved = [&](const auto &read)
      { return x_1 * read.row(b).cwiseAbs().array() + x_2 * read.row(measures.n_p + b).cwiseAbs().array(); };
      constexpr double looked_at = 1e-3; // least part of a mode in a measure's largest excursion
      if (((moved(measures.read_u) + moved(measures.read_v) / rate).transpose() > looked_at * context_.scale.array())
              .any())
        most = h * rate;
    }
  }
  constexpr int most_parts = 4096; // of a step: a bound for motions that run away
  return most > furthest_turn ? int(std::min(std::ceil(most / furthest_turn), double(most_parts))) : 1;
}

/// Collocation satisfies the rates of sticking measures only at its nodes.
void ModalPropagation::hold_rates(double t, Eigen::VectorXd &x) const
{
  if (system_.forces().held().empty())
    return;
  held_.t           = t;
  held_.v.noalias() = context_.measures.read_v.transpose() * x;
  context_.project_held(x, held_);
}

const Eigen::VectorXd &ModalPropagation::state_at(double t) const
{
  const double h = local_.t - t_begin_;
  if (t >= local_.t || !(h > 0.))
  {
    if (!stepped_ || (cut_ && !(h > 0.)))
      force_->begin_state(x_work_);
    else
      force_->end_state(x_work_);
    return x_work_;
  }
  if (t_inside_ > t_begin_ && t == t_inside_)
    return x_inside_;
  force_->begin_state(x_inside_);
  if (t > t_begin_)
  {
    force_->forces(forces_);
    carry_inside(context_.measures, force_->basis(), t - t_begin_, h, forces_, x_inside_);
    hold_rates(t, x_inside_);
  }
  t_inside_ = t;
  return x_inside_;
}

void ModalPropagation::interpolate(double t, Eigen::VectorXd &q, Eigen::VectorXd &v) const
{
  const Eigen::VectorXd &x = state_at(t);
  q.noalias()              = Q_ * x;
  v.noalias()              = V_ * x;
}

void ModalPropagation::motion_at(double t, const std::vector<int> &coordinates, Eigen::VectorXd &q,
                                 Eigen::VectorXd &v) const
{
  const Eigen::VectorXd &x = state_at(t);
  for (const int i : coordinates)
  {
    q[i] = Q_.row(i).dot(x);
    v[i] = V_.row(i).dot(x);
  }
}

void ModalPropagation::fail(const std::string &reason) const
{
  std::ostringstream message;
  message << reason << " at t = " << local_begin_.t << " s; the step was halved to " << spacing(rung_)
          << " s; use a smaller step, locate events, or increase the tolerance if it is near rounding";
  throw ConvergenceFailure(message.str());
}

} // namespace gestell::coupling
