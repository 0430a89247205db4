#include "coupling/sensitivity/variational_steps.h"

#include "coupling/integration/system/convergence_failure.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace gestell::coupling
{

namespace
{
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// L-stable, order 4: Hairer and Wanner II, table IV.6.5
constexpr double gamma         = 0.25;
constexpr double at_shares[5]  = {1. / 4., 3. / 4., 11. / 20., 1. / 2., 1.};
constexpr double weights[5][4] = {{0., 0., 0., 0.},
                                  {1. / 2., 0., 0., 0.},
                                  {17. / 50., -1. / 25., 0., 0.},
                                  {371. / 1360., -137. / 2720., 15. / 544., 0.},
                                  {25. / 24., -49. / 48., 125. / 16., -85. / 12.}};
/// Weights of the method minus those of the embedded method.
constexpr double differences[5] = {25. / 24. - 59. / 48., -49. / 48. + 17. / 96., 125. / 16. - 225. / 32., 0., 1. / 4.};

constexpr int middle = 3; ///< stage at half a step

/// The equations without what parameters change.
Linearised homogeneous(const Linearised &at)
{
  Linearised bare = at;
  for (MatrixXd *right : {&bare.r, &bare.p, &bare.g, &bare.g_rate, &bare.gamma})
    right->setZero();
  for (MatrixXd *right : {&bare.u, &bare.v, &bare.a})
    right->resize(0, 0);
  return bare;
}
} // namespace

void PieceReader::begin(const SmoothPiece &piece)
{
  piece_ = &piece;
  here_  = 0;
  known_ = {{{piece.nodes.size(), {}}, {piece.nodes.size(), {}}}};
}

const VectorXd &PieceReader::acceleration(std::size_t node)
{
  auto &kept = known_[node % 2];
  if (kept.first != node)
  {
    const MotionNode &at = piece_->nodes[node];
    node_.t              = at.t;
    node_.q              = at.q;
    node_.v              = at.v;
    if (node_.local.u.size() == 0)
      node_.local.resize(equation_.machine());
    equation_.linearisation().complete(node_);
    kept = {node, node_.a};
  }
  return kept.second;
}

double PieceReader::spacing() const
{
  return here_ + 1 < piece_->nodes.size() ? piece_->nodes[here_ + 1].t - piece_->nodes[here_].t : 0.;
}

void PieceReader::read(double close, MotionState &state)
{
  const auto  &nodes = piece_->nodes;
  const double t     = state.t;
  while (here_ + 2 < nodes.size() && t >= nodes[here_ + 1].t)
    ++here_;
  while (here_ > 0 && t < nodes[here_].t)
    --here_;
  const MotionNode &a = nodes[here_], &b = nodes[std::min(here_ + 1, nodes.size() - 1)];
  const double      h            = b.t - a.t;
  constexpr double  same_instant = 1e-9; // of the distance of nodes: rounding of times
  for (const MotionNode *node : {&a, &b})
    if (std::abs(t - node->t) <= same_instant * h || h == 0.)
    {
      state.q = node->q;
      state.v = node->v;
      return;
    }
  const double x = (t - a.t) / h, y = 1. - x;
  const bool   near = h <= close;
  if (near || !equation_.lags().empty())
  {
    state.q = (1. + 2. * x) * y * y * a.q + x * x * (1. + 2. * y) * b.q + h * x * y * (y * a.v - x * b.v);
    state.v = 6. * x * y / h * (b.q - a.q) + y * (1. - 3. * x) * a.v + x * (3. * x - 2.) * b.v;
  }
  if (near)
    return;
  VectorXd q_cubic, v_cubic; // of lags, that have no accelerations
  if (!equation_.lags().empty())
  {
    q_cubic = state.q;
    v_cubic = state.v;
  }
  const VectorXd &a_a = acceleration(here_), &a_b = acceleration(here_ + 1);
  const double    x2 = x * x, x3 = x2 * x, x4 = x3 * x, x5 = x4 * x;
  const double    rise = 10. * x3 - 15. * x4 + 6. * x5, rise_rate = 30. * x2 - 60. * x3 + 30. * x4;
  state.q = a.q + rise * (b.q - a.q) +
            h * ((x - 6. * x3 + 8. * x4 - 3. * x5) * a.v + (-4. * x3 + 7. * x4 - 3. * x5) * b.v) +
            h * h * (0.5 * (x2 - 3. * x3 + 3. * x4 - x5) * a_a + 0.5 * (x3 - 2. * x4 + x5) * a_b);
  state.v = rise_rate / h * (b.q - a.q) + (1. - 18. * x2 + 32. * x3 - 15. * x4) * a.v +
            (-12. * x2 + 28. * x3 - 15. * x4) * b.v +
            h * (0.5 * (2. * x - 9. * x2 + 12. * x3 - 5. * x4) * a_a + 0.5 * (3. * x2 - 8. * x3 + 5. * x4) * a_b);
  for (const int i : equation_.lags())
  {
    state.q[i] = q_cubic[i];
    state.v[i] = v_cubic[i];
  }
}

VariationalSteps::VariationalSteps(VariationalEquation &equation, double first, double tolerance, int run_order,
                                   double run_step)
    : equation_(equation), reader_(equation), step_(first), tolerance_(tolerance), run_order_(run_order),
      run_step_(run_step)
{
  size_q_.setZero(equation.machine().size(), equation.n_parameters());
  size_v_ = size_q_;
  for (MotionState *state : {&state_, &stage_state_})
    state->local.resize(equation.machine());
  root_mass_ = equation.mass_diagonal().cwiseSqrt();
  accuracy_.off.setZero(equation.n_parameters());
  of_run_ = settled_ = accuracy_.off;
  left_.q = left_.v = size_q_;
}

/// Some of its instants.
void VariationalSteps::look_along(const SmoothPiece &piece)
{
  std::vector<MotionState> passed;
  constexpr std::size_t    looks           = 7;  // at least, in each piece
  constexpr std::size_t    nodes_of_a_look = 20; // a term that is zero at all looks acts for fewer nodes
  const std::size_t        last = piece.nodes.size() - 1, n = std::max(looks, last / nodes_of_a_look);
  for (std::size_t i = 0; i <= n; ++i)
  {
    const MotionNode &node = piece.nodes[last * i / n];
    MotionState       at   = state_;
    at.t                   = node.t;
    at.q                   = node.q;
    at.v                   = node.v;
    equation_.linearisation().complete(at);
    passed.push_back(std::move(at));
  }
  equation_.linearisation().begin_piece(passed);
}

void VariationalSteps::expect(const MatrixXd &s, const MatrixXd &s_rate)
{
  size_q_ = s;
  size_v_ = s_rate;
}

void VariationalSteps::separate_shifts(const VectorXd &way, const VectorXd &speed, const Eigen::RowVectorXd &longest)
{
  longest_               = longest;
  const double   largest = root_mass_.cwiseProduct(way).maxCoeff(), fastest = root_mass_.cwiseProduct(speed).maxCoeff();
  const VectorXd none          = VectorXd::Zero(way.size());
  constexpr double still_share = 1e-12; // of the largest way, in the norm of the mass: less is rounding
  per_way_   = (root_mass_.cwiseProduct(way).array() > still_share * largest).select(way.cwiseInverse(), none);
  per_speed_ = (root_mass_.cwiseProduct(speed).array() > still_share * fastest).select(speed.cwiseInverse(), none);
}

void VariationalSteps::begin(const SmoothPiece &piece, const VectorXd &lambda, const MatrixXd &s,
                             const MatrixXd &s_rate)
{
  reader_.begin(piece);
  state_.t            = piece.nodes.front().t;
  state_.q            = piece.nodes.front().q;
  state_.v            = piece.nodes.front().v;
  state_.local.lambda = lambda;
  equation_.linearisation().complete(state_);
  look_along(piece);
  equation_.linearisation().linearise(state_, at_);
  columns_.q = s;
  columns_.v = s_rate;
  equation_.solve(at_, 0., columns_);
  split();
  settle_errors();
}

void VariationalSteps::settle_errors()
{
  if (!leaves_ || equation_.machine().forces().held().empty())
    return;
  settled_ += relative_sizes(left_.q, left_.v);
  left_.q.setZero();
  left_.v.setZero();
  leaves_ = false;
}

/// Splits s into a time shift tau q' and a rest: tau = (s . q' + s' . q'')/(q' . q' + q'' . q''), each coordinate and
/// rate relative to its own motion. Applied only if the rest is small and tau not too long: at rest q' is rounding.
void VariationalSteps::split()
{
  shift_.setZero(columns_.q.cols());
  rest_q_           = columns_.q;
  rest_v_           = columns_.v;
  const auto square = [&](const auto &q, const auto &v)
  { return per_way_.cwiseProduct(q).squaredNorm() + per_speed_.cwiseProduct(v).squaredNorm(); };
  const double moving = per_way_.size() > 0 ? square(state_.v, state_.a) : 0.;
  for (Index k = 0; k < shift_.size() && moving > 0.; ++k)
  {
    const VectorXd s = columns_.q.col(k), s_rate = columns_.v.col(k);
    const double   tau = (per_way_.cwiseProduct(s).dot(per_way_.cwiseProduct(state_.v)) +
                        per_speed_.cwiseProduct(s_rate).dot(per_speed_.cwiseProduct(state_.a))) /
                       moving;
    const VectorXd q = s - tau * state_.v, v = s_rate - tau * state_.a;
    // of s, in a shift: else errors of the run, times tau, count little in peaks
    constexpr double small_rest = 0.01;
    if (!(square(q, v) <= small_rest * small_rest * square(s, s_rate) && std::abs(tau) <= longest_[k]))
      continue;
    shift_[k]      = tau;
    rest_q_.col(k) = q;
    rest_v_.col(k) = v;
  }
  size_q_ = size_q_.cwiseMax(rest_q_.cwiseAbs());
  size_v_ = size_v_.cwiseMax(rest_v_.cwiseAbs());
}

/// After a step of the rest: s and all other columns.
void VariationalSteps::join()
{
  if (shift_.isZero(0.))
    return;
  columns_.q += state_.v * shift_;
  columns_.v += state_.a * shift_;
  equation_.solve(at_, 0., columns_);
}

bool VariationalSteps::advance_to(double t, const std::atomic<bool> *stop)
{
  int halvings = 0;
  while (state_.t < t - 1e-13 * std::max(std::abs(t), step_))
  {
    if (stop && stop->load(std::memory_order_relaxed))
      return false;
    const double     from           = state_.t;
    const double     left           = t - from;
    constexpr double nearly         = 1.0001; // steps: what is left is one step, not one and a hair
    const bool       last           = left <= nearly * step_;
    const double     length         = last ? left : step_;
    const bool       made           = try_step(last ? t : from + length);
    const double     err            = error(length);
    constexpr double shortest_share = 1. / 16.; // of the distance of nodes: the motion in between is not known better
    if (!made || (!(err <= 1.) && length > shortest_share * reader_.spacing()))
    {
      constexpr int most_halvings = 30; // 1e-9 of a step
      if (++halvings > most_halvings)
        throw ConvergenceFailure("the derivatives of the motion cannot be integrated beyond t = " +
                                 std::to_string(from) + " s: their steps became too short");
      while (nearly * step_ >= length)
        step_ *= 0.5;
      continue;
    }
    halvings = 0;
    note_accuracy(err, length);
    std::swap(state_, stage_state_);
    std::swap(at_, stage_at_);
    std::swap(columns_, stage_);
    join();
    equation_.close_joints(at_, columns_);
    if (leaves_)
      equation_.close_joints(homogeneous(at_), left_);
    ++n_steps_;
    split();
    constexpr double growth = 1. / 32.; // error of a step whose double is tried next: half of 2^-4
    if (!last && (err < growth || 2. * step_ <= shortest_share * reader_.spacing()))
      step_ *= 2.;
  }
  return true;
}

bool VariationalSteps::try_step(double to)
{
  const double from = state_.t, H = to - from, c = gamma * H;
  const bool   shifted      = !shift_.isZero(0.);
  stage_state_.local.lambda = state_.local.lambda;
  stage_state_.local.p      = state_.local.p;
  for (int i = 0; i < n_stages; ++i)
  {
    stage_state_.t = i == n_stages - 1 ? to : from + at_shares[i] * H;
    reader_.read(0.25 * H, stage_state_);
    equation_.linearisation().complete(stage_state_);
    constexpr double time_share = 0.01; // of a step: increment of quotients in time
    equation_.linearisation().linearise(stage_state_, stage_at_, shifted ? time_share * H : 0.);
    if (leaves_ && i == middle)
    {
      left_next_ = left_;
      equation_.solve(homogeneous(stage_at_), 0.5 * H, left_next_);
      left_next_.q = 2. * left_next_.q - left_.q;
      left_next_.v = 2. * left_next_.v - left_.v;
    }
    stage_.q = rest_q_;
    stage_.v = rest_v_;
    for (int j = 0; j < i; ++j)
    {
      stage_.q += H * weights[i][j] * v_[j];
      stage_.v += H * weights[i][j] * a_[j];
    }
    if (shifted)
      shift_loads(-1., stage_at_);
    equation_.solve(stage_at_, c, stage_);
    v_[i] = stage_.v;
    a_[i] = stage_.a;
  }
  if (shifted)
    shift_loads(1., stage_at_);
  return stage_.a.allFinite();
}

/// Change of time-dependent loads by the time shift.
void VariationalSteps::shift_loads(double sign, Linearised &at) const
{
  at.r += sign * at.r_t * shift_;
  at.p += sign * at.p_t * shift_;
  at.gamma += sign * at.gamma_t * shift_;
}

/// Error of the step against the tolerance.
double VariationalSteps::error(double length)
{
  const auto embedded = [&](const std::array<MatrixXd, n_stages> &f) -> MatrixXd
  { return length * (differences[0] * f[0] + differences[1] * f[1] + differences[2] * f[2] + differences[4] * f[4]); };
  e_q_ = embedded(v_);
  e_v_ = embedded(a_);
  return relative_sizes(e_q_, e_v_).maxCoeff() / tolerance_;
}

/// Adds the errors of steps beyond the tolerance and their propagation: where quotients of the machines are rounding,
/// no step meets the tolerance. Also adds the errors of the steps of the run over their length, h y''/2 for order 1 and
/// h^2 y'''/3 for order 2.
void VariationalSteps::note_accuracy(double error, double length)
{
  if (leaves_)
    std::swap(left_, left_next_);
  if (error > 1.)
  {
    left_.q += e_q_;
    left_.v += e_v_;
    leaves_ = true;
  }
  if (leaves_)
  {
    const auto &W = equation_.machine().forces().directions();
    left_.u       = W.transpose() * left_.q;
    left_.u_rate  = W.transpose() * left_.v;
  }
  if (run_order_ > 0)
  {
    constexpr double longest_told = 4.; // steps of the run per step here: beyond, differences are not usable
    const double     h            = std::min(run_step_, longest_told * length);
    for (const auto &[e, f] : {std::pair(&e_q_, &v_), std::pair(&e_v_, &a_)}) // stages 0, 3, 1: a quarter step apart
      *e = run_order_ == 1 ? MatrixXd(h * ((*f)[1] - (*f)[0]))
                           : MatrixXd(16. / 3. * h * h / length * ((*f)[0] - 2. * (*f)[3] + (*f)[1]));
    of_run_ += relative_sizes(e_q_, e_v_);
  }
  accuracy_.off          = accuracy_.off.cwiseMax(of_run_ + settled_ + relative_sizes(left_.q, left_.v));
  constexpr double never = std::numeric_limits<double>::infinity();
  if (accuracy_.off.maxCoeff() > accuracy_.believed && accuracy_.after == never)
    accuracy_.after = state_.t;
}

/// Largest of e_q, e_v for each parameter, each coordinate by its own size.
Eigen::RowVectorXd VariationalSteps::relative_sizes(const MatrixXd &e_q, const MatrixXd &e_v) const
{
  Eigen::RowVectorXd largest = Eigen::RowVectorXd::Zero(size_q_.cols());
  for (const auto &[e, before, now] : {std::tuple(&e_q, &size_q_, &stage_.q), std::tuple(&e_v, &size_v_, &stage_.v)})
    for (Index k = 0; k < e->cols(); ++k)
    {
      double           floor = 0.;
      constexpr double weak  = 0.1; // coordinates that move less, in the norm of the mass, count as that
      for (Index i = 0; i < e->rows(); ++i)
        floor = std::max(floor, weak * root_mass_[i] * std::max((*before)(i, k), std::abs((*now)(i, k))));
      for (Index i = 0; i < e->rows(); ++i)
      {
        if (e == &e_v && root_mass_[i] == 0.) // rates of lags follow their law at once
          continue;
        const double own   = std::max((*before)(i, k), std::abs((*now)(i, k)));
        const double scale = root_mass_[i] > 0. ? std::max(own, floor / root_mass_[i]) : own;
        if (scale > 0.)
          largest[k] = std::max(largest[k], std::abs((*e)(i, k)) / scale);
      }
    }
  return largest;
}

} // namespace gestell::coupling
