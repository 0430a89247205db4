#include "coupling/fast_forces.h"

#include "coupling/dense_modes.h"
#include "fem/two_pi.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace gestell::coupling
{

namespace
{

/// Damping ratios of the pairs of poles of Butterworth's filter of fourth order: cos(pi / 8), cos(3 pi / 8).
constexpr std::array<double, HighPass::n_sections> ratios = {0.92387953251128674, 0.38268343236508978};

/// Part of a deflection from which a doubt is worth a word: five times what the reduction leaves by default.
constexpr double worth_a_word = 0.05;

constexpr int most_named = 3;

/// Two digits.
std::string percent_of(double part, double whole)
{
  std::ostringstream text;
  text.precision(2);
  text << 100. * part / whole << " %";
  return text.str();
}

} // namespace

HighPass::Step::Step(double omega, double h) : omega(omega), h(h)
{
  for (int i = 0; i < n_sections; ++i)
  {
    const double zeta = ratios[i], s = std::sqrt(1. - zeta * zeta), theta = omega * h;
    const double decay = std::exp(-zeta * theta), c = decay * std::cos(s * theta), d = decay * std::sin(s * theta) / s;
    E[i] = {c + zeta * d, d, -d, c - zeta * d};
  }
}

void HighPass::begin(double u)
{
  for (Section &section : sections_)
  {
    section = {u, 0., u};
    u       = 0.;
  }
}

double HighPass::advance(const Step &step, double u)
{
  for (int i = 0; i < n_sections; ++i)
  {
    Section     &own  = sections_[i];
    const double rate = (u - own.u) / (step.h * step.omega), late = 2. * ratios[i] * rate; // the ramp's own solution
    const double x = own.x - own.u + late, r = own.rate - rate;
    own.x    = step.E[i][0] * x + step.E[i][1] * r + u - late;
    own.rate = step.E[i][2] * x + step.E[i][3] * r + rate;
    own.u    = u;
    u        = own.output(ratios[i]);
  }
  return u;
}

double HighPass::jump(double u)
{
  for (int i = 0; i < n_sections; ++i)
  {
    sections_[i].u = u;
    u              = sections_[i].output(ratios[i]);
  }
  return u;
}

void FastForces::Range::add(double x)
{
  least = std::min(least, x);
  most  = std::max(most, x);
}

FastForces::FastForces(const Machine &machine, const TimeIntegrator &integrator) : integrator_(integrator)
{
  const ReducedFrame *frame = machine.reduced_frame();
  if (!frame || !frame->modal || !(frame->frequency_limit_hz > 0.))
    return;
  limit_                  = frame->frequency_limit_hz;
  const Eigen::MatrixXd W = Eigen::MatrixXd(machine.directions()).topRows(machine.n_frame());
  int                   i = 0;
  for (const ElementPlacement &placement : machine.elements())
    for (int k = 0; k < placement.element->n_measures(); ++k, ++i)
      if (!W.col(i).isZero(0.))
        forces_.push_back({placement.name, i});
  if (forces_.empty())
    return;
  steps_.reserve(n_corners);
  const DenseModes modes = dense_modes(frame->C, frame->M, cancelled_by_reduction, frame->n_rigid());
  const auto       p = modes.omega.size() - frame->n_rigid(), m = Eigen::Index(forces_.size());
  Eigen::MatrixXd  w(W.rows(), m);
  for (Eigen::Index j = 0; j < m; ++j)
    w.col(j) = W.col(forces_[j].measure);
  const Eigen::VectorXd omega = modes.omega.tail(p);
  const Eigen::MatrixXd y     = omega.cwiseInverse().asDiagonal() * (modes.V.rightCols(p).transpose() * w);
  flexibility_                = (y.transpose() * y).cwiseAbs();
  const auto within           = (omega.array() <= two_pi * limit_).count();
  for (Eigen::Index j = 0; j < m; ++j)
  {
    forces_[j].above = y.col(j).tail(p - within).squaredNorm();
    forces_[j].whole = flexibility_(j, j);
  }
}

void FastForces::begin()
{
  t_ = integrator_.time();
  for (Force &force : forces_)
  {
    const double p = integrator_.local().p[force.measure];
    force.value    = {p, p};
    for (HighPass &filter : force.filters)
      filter.begin(p);
  }
}

void FastForces::step()
{
  const double h = integrator_.time() - t_;
  if (forces_.empty() || !(h > 0.))
    return;
  if (steps_.empty() || steps_.front().h != h)
  {
    steps_.clear();
    for (int corner = 0; corner < n_corners; ++corner)
      steps_.emplace_back(two_pi * limit_ * (1 << corner), h);
  }
  for (Force &force : forces_)
  {
    const double p = integrator_.local().p[force.measure];
    force.value.add(p);
    for (int corner = 0; corner < n_corners; ++corner)
      force.fast[corner].add(force.filters[corner].advance(steps_[corner], p));
  }
  t_ = integrator_.time();
}

void FastForces::jump()
{
  for (Force &force : forces_)
  {
    const double p = integrator_.local().p[force.measure];
    force.value.add(p);
    for (int corner = 0; corner < n_corners; ++corner)
      force.fast[corner].add(force.filters[corner].jump(p));
  }
}

double FastForces::doubt(std::size_t force, int corner) const
{
  double deflection = 0.;
  for (std::size_t j = 0; j < forces_.size(); ++j)
    deflection += flexibility_(Eigen::Index(force), Eigen::Index(j)) * forces_[j].value.length();
  return deflection > 0. ? forces_[force].above * forces_[force].fast[corner].length() / deflection : 0.;
}

std::string FastForces::warning() const
{
  std::vector<std::size_t> doubtful;
  int                      enough = 0; // corner that would leave no doubt
  for (std::size_t i = 0; i < forces_.size(); ++i)
  {
    if (!(doubt(i, 0) > worth_a_word))
      continue;
    doubtful.push_back(i);
    while (enough < n_corners && doubt(i, enough) > worth_a_word)
      ++enough;
  }
  if (doubtful.empty())
    return "";
  std::sort(doubtful.begin(), doubtful.end(), [&](auto i, auto j) { return doubt(i, 0) > doubt(j, 0); });
  std::ostringstream text;
  text << "forces change faster than the reduced frame, made to hold up to " << limit_ << " Hz, can follow: ";
  for (std::size_t k = 0; k < std::min<std::size_t>(doubtful.size(), most_named); ++k)
  {
    const Force &force = forces_[doubtful[k]];
    text << (k > 0 ? "; " : "") << "of " << force.element << ' '
         << percent_of(force.fast[0].length(), force.value.length()) << " lie above, where modes carry "
         << percent_of(force.above, force.whole) << " of the flexibility at its place, so that about "
         << percent_of(doubt(doubtful[k], 0), 1.) << " of the deflection there is in doubt";
  }
  if (doubtful.size() > most_named)
    text << "; and " << doubtful.size() - most_named << " more";
  text << ". Give reduction.frequency a larger value: ";
  if (enough < n_corners)
    text << limit_ * (1 << enough) << " Hz holds what they contain";
  else
    text << "more than " << limit_ * (1 << (n_corners - 1))
         << " Hz would be needed; double it until the answer stays as it is";
  return text.str();
}

} // namespace gestell::coupling
