#include "coupling/simulation/checks/force_bandwidth_check.h"
#include "coupling/integration/system/state_archive.h"

#include "coupling/algebra/dense_modes.h"
#include "coupling/machine/configuration/dense_matrices.h"
#include "coupling/modes/modes.h"
#include "fem/values/two_pi.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace gestell::coupling
{

namespace
{

using Eigen::ArrayXd;
using Eigen::ArrayXXd;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Two digits.
std::string percent_of(double share)
{
  std::ostringstream text;
  text.precision(share < 0.995 ? 2 : 3);
  text << 100. * share << " %";
  return text.str();
}

/// omega' [rad/s]: modes with unknown errors are assumed to be above the known ones, or above the range.
VectorXd refined(const ReducedFrame &frame, const VectorXd &omega)
{
  VectorXd result(omega.size());
  double   last = two_pi * frame.frequency_limit_hz;
  for (Eigen::Index k = 0; k < omega.size(); ++k)
  {
    const double known = two_pi * refined_hz(frame, k + frame.n_rigid());
    result[k]          = std::min(omega[k], std::isnan(known) ? last : known);
    last               = std::max(last, result[k]);
  }
  return result;
}

/// Springs or dampers [n x n] of the base system in addition to the frame.
MatrixXd beside_frame(MatrixXd base, const MatrixXd &frame)
{
  base.topLeftCorner(frame.rows(), frame.cols()) -= frame;
  return base;
}

} // namespace

ForceBandwidthCheck::ForceBandwidthCheck(const Machine &machine, const TimeIntegrator &integrator)
    : integrator_(integrator)
{
  const ReducedFrame *frame = machine.model().reduced_frame();
  if (!frame || !frame->modal || !(frame->frequency_limit_hz > 0.))
    return;
  limit_             = frame->frequency_limit_hz;
  const int      n_f = machine.model().n_frame(), n_b = machine.size() - n_f;
  const MatrixXd W       = MatrixXd(machine.forces().directions()).topRows(n_f);
  const MatrixXd springs = beside_frame(dense_stiffness(machine), frame->C),
                 dampers = beside_frame(dense_damping(machine), frame->B);
  int i                  = 0;
  for (const ElementPlacement &placement : machine.model().elements())
    for (int k = 0; k < placement.element->n_measures(); ++k, ++i)
      if (!W.col(i).isZero(0.))
        places_.push_back({placement.name, W.col(i), i});
  for (int j = 0; j < frame->n_interface; ++j)
    if (!springs.row(j).tail(n_b).isZero(0.) || !dampers.row(j).tail(n_b).isZero(0.))
      places_.push_back({machine.coordinate_name(j), VectorXd::Unit(n_f, j), -1, -springs.row(j), -dampers.row(j)});
  if (places_.empty())
    return;
  take_forces(machine, W, springs, dampers);
  take_modes(*frame);
}

/// Stored as loads on the frame, until take_modes() converts them to loads on its modes.
void ForceBandwidthCheck::take_forces(const Machine &machine, const MatrixXd &W, const MatrixXd &springs,
                                      const MatrixXd &dampers)
{
  const Eigen::Index n_f = W.rows();
  by_measures_           = W;
  if (!machine.linear().excitation().is_constant())
  {
    excitation_ = &machine.linear().excitation();
    by_loads_   = MatrixXd::Identity(n_f, machine.size());
    load_       = VectorXd::Zero(machine.size());
  }
  if (springs.isZero(0.) && dampers.isZero(0.))
    return;
  for (int i = 0; i < machine.size(); ++i)
    if (!springs.col(i).isZero(0.) || !dampers.col(i).isZero(0.))
      sprung_.push_back(i);
  by_motion_ = -springs.topRows(n_f)(Eigen::all, sprung_);
  by_rates_  = -dampers.topRows(n_f)(Eigen::all, sprung_);
}

void ForceBandwidthCheck::take_modes(const ReducedFrame &frame)
{
  const DenseModes   modes = dense_modes(frame.C, frame.M, cancelled_by_reduction, frame.n_rigid());
  const Eigen::Index p     = modes.omega.size() - frame.n_rigid();
  const VectorXd     omega = modes.omega.tail(p), lower = refined(frame, omega);
  const MatrixXd     V = modes.V.rightCols(p);

  MatrixXd w(V.rows(), places_.size());
  for (std::size_t i = 0; i < places_.size(); ++i)
    w.col(Eigen::Index(i)) = places_[i].direction;
  const ArrayXXd share = (w.transpose() * V * omega.cwiseInverse().asDiagonal()).array().square(); // of flexibilities
  const ArrayXd  whole = share.rowwise().sum().max(std::numeric_limits<double>::min());
  std::vector<Eigen::Index> taken;
  // Share of the flexibility at every point below which a mode is ignored: less than a hundredth of worth_a_word.
  constexpr double takes_part = 1e-4;
  for (Eigen::Index k = 0; k < p; ++k)
    if ((share.col(k) / whole).maxCoeff() > takes_part)
      taken.push_back(k);

  const MatrixXd Phi   = V(Eigen::all, taken);
  const ArrayXd  model = omega(taken), full = lower(taken);
  for (std::size_t i = 0; i < places_.size(); ++i)
    places_[i].above =
        (full > two_pi * limit_).select(share(Eigen::Index(i), taken).transpose(), 0.).sum() / whole[Eigen::Index(i)];
  for (int range = 1; range < n_ranges; ++range)
    first_[range] = (full <= two_pi * limit_ * (1 << range)).count();

  shapes_ = w.transpose() * Phi * model.square().inverse().matrix().asDiagonal();
  for (MatrixXd *load : {&by_measures_, &by_loads_, &by_motion_, &by_rates_})
    if (load->rows() > 0) // without forces except base springs by_measures_ has no columns
      *load = (Phi.transpose() * *load).eval();

  const ArrayXd zeta = (Phi.transpose() * frame.B * Phi).diagonal().array() / (2. * model);
  // Damping ratio where the frame has none, as the reduction's own estimate of receptances takes it.
  constexpr double undamped   = 0.01;
  constexpr double overdamped = 0.99; // Damping ratio to which oscillators are limited that would not swing.
  const ArrayXd    own        = (zeta > 0.).select(zeta, undamped).min(overdamped);
  ArrayXd          both(2 * model.size()), ratios(2 * model.size());
  both << model, full;
  ratios << own, own;
  bank_ = OscillatorBank(both, ratios);
}

const ArrayXd &ForceBandwidthCheck::inputs(const VectorXd &p, double t)
{
  const bool is_mean = t < integrator_.time();
  force_.noalias()   = by_measures_ * p;
  if (by_motion_.size() > 0)
  {
    const Instant &now = integrator_.instant();
    sprung_now_.setZero(force_.size());
    for (std::size_t k = 0; k < sprung_.size(); ++k)
      sprung_now_ +=
          now.q[sprung_[k]] * by_motion_.col(Eigen::Index(k)) + now.v[sprung_[k]] * by_rates_.col(Eigen::Index(k));
    if (is_mean)
      force_ += 0.5 * (sprung_before_ + sprung_now_);
    else
      force_ += sprung_now_;
    sprung_before_.swap(sprung_now_);
  }
  if (excitation_)
  {
    excitation_->at(t, load_);
    force_.noalias() += by_loads_ * load_;
  }
  input_ << force_.array(), force_.array();
  return input_;
}

void ForceBandwidthCheck::begin()
{
  if (places_.empty())
    return;
  const Eigen::Index n = Eigen::Index(places_.size()), modes = shapes_.cols();
  t_ = t_step_                     = integrator_.time();
  constexpr double looks_in_period = 32.; // of the range's limit: a sine is missed by (pi / 32)^2 / 2 = 0.5 %
  pace_                            = 1. / (looks_in_period * limit_);
  p_                               = measured();
  impulse_                         = VectorXd::Zero(p_.size());
  force_.resize(modes);
  input_.resize(2 * modes);
  bank_.begin(inputs(measured(), t_));
  at_rest_    = shapes_ * bank_.x().head(modes).matrix();
  deflection_ = ArrayXd::Zero(n);
  sum_.resize(n);
  difference_.resize(modes);
  error_ = ArrayXXd::Zero(n, n_ranges);
  least_.resize(n);
  for (std::size_t i = 0; i < places_.size(); ++i)
    least_[Eigen::Index(i)] = force_on(places_[i]);
  most_ = least_;
}

double ForceBandwidthCheck::force_on(const Place &place) const
{
  if (place.measure >= 0)
    return integrator_.local().p[place.measure];
  const Instant &now = integrator_.instant();
  return place.spring.dot(now.q) + place.damper.dot(now.v);
}

void ForceBandwidthCheck::look()
{
  const Eigen::Index modes = shapes_.cols();
  const auto         x     = bank_.x().head(modes).matrix();
  sum_.noalias()           = shapes_ * x;
  deflection_              = deflection_.max((sum_ - at_rest_).array().abs());
  difference_              = x - bank_.x().tail(modes).matrix();
  sum_.setZero();
  for (Eigen::Index range = n_ranges, end = modes; range-- > 0; end = first_[range])
  {
    const Eigen::Index n = end - first_[range];
    sum_.noalias() += shapes_.middleCols(first_[range], n) * difference_.segment(first_[range], n);
    error_.col(range) = error_.col(range).max(sum_.array().abs());
  }
  for (std::size_t i = 0; i < places_.size(); ++i)
  {
    const double p = force_on(places_[i]);
    least_[i]      = std::min(least_[i], p);
    most_[i]       = std::max(most_[i], p);
  }
}

void ForceBandwidthCheck::step()
{
  const double now = integrator_.time(), h = now - t_step_;
  if (places_.empty() || !(h > 0.))
    return;
  const bool whole = t_step_ == t_; // the step is all there is since the last look
  impulse_ += 0.5 * h * (p_ + measured());
  p_      = measured();
  t_step_ = now;
  if (now - t_ < pace_)
    return;
  if (!whole)
    impulse_ /= now - t_; // the mean
  bank_.advance(now - t_, whole ? inputs(p_, now) : inputs(impulse_, 0.5 * (t_ + now)));
  impulse_.setZero();
  t_ = now;
  look();
}

void ForceBandwidthCheck::event(const Event &)
{
  if (places_.empty())
    return;
  p_ = measured();
  if (t_step_ > t_)
    return; // part of a mean
  bank_.jump(inputs(p_, t_));
  look();
}

double ForceBandwidthCheck::doubt(std::size_t place, int range) const
{
  const auto i = Eigen::Index(place);
  return deflection_[i] > 0. ? error_(i, range) / deflection_[i] : 0.;
}

void ForceBandwidthCheck::finish(RunOutcome &outcome)
{
  std::vector<std::size_t> doubtful;
  int                      enough = 0; // range that would leave no doubt
  const ArrayXd            work   = (most_ - least_) * deflection_;
  for (std::size_t i = 0; i < places_.size(); ++i)
  {
    // Share of a deflection above which a note is printed: five times the default error of the reduction.
    constexpr double worth_a_word = 0.05;
    // Share of the largest work of a force above which its deflection is included: a tenth of the size for deflections
    // of one kind.
    constexpr double counts = 0.01;
    if (!(doubt(i, 0) > worth_a_word && work[Eigen::Index(i)] > counts * work.maxCoeff()))
      continue;
    doubtful.push_back(i);
    while (enough < n_ranges && doubt(i, enough) > worth_a_word)
      ++enough;
  }
  if (doubtful.empty())
    return;
  std::sort(doubtful.begin(), doubtful.end(), [&](auto i, auto j) { return doubt(i, 0) > doubt(j, 0); });
  std::ostringstream text;
  text << "forces change faster than the reduced frame (frequency limit " << limit_ << " Hz) can follow: ";
  constexpr int most_named = 3; // places of one message
  for (std::size_t k = 0; k < std::min<std::size_t>(doubtful.size(), most_named); ++k)
  {
    const Place &place = places_[doubtful[k]];
    text << (k > 0 ? "; " : "") << "at " << place.name << ", where omitted modes have " << percent_of(place.above)
         << " of the flexibility, about " << percent_of(doubt(doubtful[k], 0)) << " of the deflection is uncertain";
  }
  if (doubtful.size() > most_named)
    text << "; and at " << doubtful.size() - most_named << " more";
  text << ". Increase reduction.frequency: ";
  if (enough < n_ranges)
    text << limit_ * (1 << enough) << " Hz covers these forces";
  else
    text << "more than " << limit_ * (1 << (n_ranges - 1))
         << " Hz is needed; double it until the response no longer changes";
  outcome.warn("force-bandwidth", places_[doubtful.front()].name, text.str());
}

void ForceBandwidthCheck::exchange(StateArchive &archive)
{
  archive(t_, t_step_, impulse_, p_, bank_, sprung_before_, sprung_now_, force_, load_, at_rest_, sum_, difference_,
          input_, deflection_, least_, most_, error_);
}

} // namespace gestell::coupling
