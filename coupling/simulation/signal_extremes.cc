#include "coupling/simulation/signal_extremes.h"

#include "coupling/integration/system/state_archive.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace gestell::coupling
{

namespace
{

constexpr int window  = 5;  ///< samples of a fourth difference
constexpr int deepest = 16; ///< pieces of a step, where `shortest` allows no more

struct Point
{
  double t, f;
};

/// Vertex of the parabola through three points of ascending t, if it is a maximum in (a, c) or nearby outside.
bool maximum(const Point &a, const Point &b, const Point &c, Point &top)
{
  const double rise = (b.f - a.f) / (b.t - a.t), curvature = ((c.f - b.f) / (c.t - b.t) - rise) / (c.t - a.t);
  if (!(curvature < 0.))
    return false;
  top.t                   = 0.5 * (a.t + b.t) - 0.5 * rise / curvature;
  top.f                   = a.f + (top.t - a.t) * (rise + curvature * (top.t - b.t));
  constexpr double nearby = 0.25; // a parabola errs by about that share of its length about a peak at its end
  const double     margin = nearby * (c.t - a.t);
  return top.t > a.t - margin && top.t < c.t + margin;
}

} // namespace

SignalExtremes::SignalExtremes(SampledRun &run, const Sampling &sampling, const std::vector<Signal> &signals,
                               double from, std::vector<SignalSummary> &summaries)
    : run_(run), sampling_(sampling), signals_(signals), from_(from), summaries_(summaries), probe_{0., {}},
      anew_(signals.size(), true)
{
  probe_.values.resize(signals.size());
  samples_.assign(2 * deepest, probe_);
  for (const Signal &signal : signals)
  {
    watched_.push_back(signal.from.empty());
    const auto alike = [&](const Signal &other) { return other.unit == signal.unit; };
    like_.push_back(int(std::find_if(signals.begin(), signals.end(), alike) - signals.begin()));
  }
}

void SignalExtremes::on_event(const std::string &event)
{
  for (std::size_t i = 0; i < signals_.size(); ++i)
    if (!watched_[i] && signals_[i].from == event)
      watched_[i] = anew_[i] = true;
}

void SignalExtremes::restart(const SignalSample &at)
{
  samples_[0] = at;
  n_          = 1;
  begin_      = 0;
  for (std::size_t i = 0; i < signals_.size(); ++i)
    if (anew_[i])
    {
      reset_extremes(i);
      anew_[i] = false;
    }
  open_ = open_ || at.t >= from_;
  see(at);
}

/// Starts the evaluation of extremes at t in the last step.
void SignalExtremes::open(double t)
{
  run_.evaluate(t, probe_);
  open_ = true;
  for (std::size_t i = 0; i < signals_.size(); ++i)
  {
    summaries_[i].min = summaries_[i].max = probe_.values[i];
    summaries_[i].t_min = summaries_[i].t_max = t;
  }
}

void SignalExtremes::reset_extremes(std::size_t signal)
{
  SignalSummary &summary = summaries_[signal];
  summary.min = summary.max = last().values[signal];
  summary.t_min = summary.t_max = last().t;
}

double SignalExtremes::slope(std::size_t signal) const
{
  if (n_ < 3)
    return std::numeric_limits<double>::quiet_NaN();
  const SignalSample *s   = &samples_[n_ - 3];
  const auto          f   = [&](int j) { return s[j].values[signal]; };
  const double        far = (f(1) - f(0)) / (s[1].t - s[0].t), near = (f(2) - f(1)) / (s[2].t - s[1].t);
  return near + (near - far) * (s[2].t - s[1].t) / (s[2].t - s[0].t);
}

void SignalExtremes::step(double end)
{
  const double begin = samples_[begin_].t, length = end - begin;
  if (!open_ && end >= from_)
    open(from_);
  if (sampling_.inside || begin_ == 0)
    divide(begin, end);
  append(end);
  if (!sampling_.inside && begin_ > 0 && rough(n_ - window))
  {
    --n_;
    divide(begin, end);
    append(end);
  }
  refine(std::min(length / deepest, sampling_.shortest));
  for (int middle = std::max(begin_, 1); middle < n_ - 1; ++middle)
    turn(middle);
  keep_the_last();
}

void SignalExtremes::append(double t)
{
  if (n_ == int(samples_.size()))
    samples_.resize(2 * n_, probe_);
  SignalSample &sample = samples_[n_];
  run_.evaluate(t, sample); // counts if it is there
  ++n_;
  see(sample);
}

void SignalExtremes::divide(double begin, double end)
{
  // Not evenly spaced: equal pieces would miss a motion whose period is a quarter of the step.
  constexpr double pieces[] = {0.23, 0.52, 0.74};
  for (const double piece : pieces)
    append(begin + piece * (end - begin));
}

/// Windows of five samples of the step, whose pieces are halved until they are smooth or `shortest` long.
void SignalExtremes::refine(double shortest)
{
  for (int first = begin_; first + window <= n_;)
  {
    const double  piece = 0.25 * (samples_[first + window - 1].t - samples_[first].t);
    constexpr int most  = 4096; // samples in a step: a bound for forces that chatter
    if (piece > shortest && n_ < begin_ + most && rough(first))
      halve(first);
    else
      first += window - 1;
  }
}

/// Halves the pieces of the window that begins there.
void SignalExtremes::halve(int first)
{
  constexpr int added = window - 1;
  if (n_ + added > int(samples_.size()))
    samples_.resize(2 * samples_.size(), probe_);
  std::rotate(samples_.begin() + first + window, samples_.begin() + n_, samples_.begin() + n_ + added);
  n_ += added;
  for (int piece = added; piece > 0; --piece)
    std::swap(samples_[first + piece], samples_[first + 2 * piece]);
  for (int k = first + 1; k < first + 2 * added; k += 2)
  {
    run_.evaluate(0.5 * (samples_[k - 1].t + samples_[k + 1].t), samples_[k]);
    see(samples_[k]);
  }
}

void SignalExtremes::keep_the_last()
{
  const int kept = std::min(n_, window - 1);
  std::rotate(samples_.begin(), samples_.begin() + (n_ - kept), samples_.begin() + n_);
  n_     = kept;
  begin_ = kept - 1;
}

/// Range of a signal so far: at least rounding, and a share of the range of others with its unit.
double SignalExtremes::range(std::size_t signal) const
{
  const auto   own    = [&](std::size_t i) { return summaries_[i].max - summaries_[i].min; };
  const double value  = std::max(std::abs(summaries_[signal].max), std::abs(summaries_[signal].min));
  double       widest = 0.;
  for (std::size_t i = 0; i < signals_.size(); ++i)
    if (like_[i] == like_[signal])
      widest = std::max(widest, own(i));
  constexpr double at_rest  = 1e-6;  // share of the range of signals in its unit: a smaller range is no motion
  constexpr double rounding = 1e-11; // of a value: fourth differences of its rounding are epsilon times that
  return std::max({own(signal), at_rest * widest, rounding * value});
}

bool SignalExtremes::rough(int first) const
{
  if (first < 0)
    return true;
  const SignalSample *s = &samples_[first];
  double              weight[window], longest = 0.;
  for (int j = 1; j < window; ++j)
    longest = std::max(longest, s[j].t - s[j - 1].t);
  for (int j = 0; j < window; ++j)
  {
    weight[j] = 1.;
    for (int k = 0; k < window; ++k)
      if (k != j)
        weight[j] *= longest / (s[j].t - s[k].t);
  }
  for (std::size_t i = 0; i < signals_.size(); ++i)
  {
    double difference = 0.;
    for (int j = 0; j < window; ++j)
      difference += weight[j] * s[j].values[i];
    // epsilon: extremes are found to 5e-5 of the range, one digit more than reports print
    constexpr double missed  = 5e-5;
    const double     missing = std::abs(difference) / missed;
    if (counts(i) && missing > summaries_[i].max - summaries_[i].min && missing > range(i))
      return true;
  }
  return false;
}

void SignalExtremes::see(const SignalSample &sample)
{
  for (std::size_t i = 0; i < signals_.size(); ++i)
    see(i, sample.t, sample.values[i]);
}

void SignalExtremes::see(std::size_t signal, double t, double value)
{
  SignalSummary &summary = summaries_[signal];
  if (!counts(signal) || t < from_)
    return;
  if (value < summary.min)
  {
    summary.min   = value;
    summary.t_min = t;
  }
  if (value > summary.max)
  {
    summary.max   = value;
    summary.t_max = t;
  }
}

/// Searches extremes beyond the known ones around three successive samples, inside the last step.
void SignalExtremes::turn(int middle)
{
  for (std::size_t i = 0; i < signals_.size(); ++i)
    for (const double sign : {-1., 1.})
      if (counts(i))
      {
        turn({i, sign, false}, middle);
        if (nears_zero({i, sign, true}, middle))
          turn({i, sign, true}, middle);
      }
}

void SignalExtremes::turn(const Sought &sought, int middle)
{
  const SignalSample *s = &samples_[middle - 1];
  Point               p[3], top;
  for (int k = 0; k < 3; ++k)
    p[k] = {s[k].t, sought.of(s[k].values[sought.signal])};
  const SignalSummary &summary = summaries_[sought.signal];
  if (maximum(p[0], p[1], p[2], top) && top.f > sought.of(sought.sign > 0. ? summary.max : summary.min))
    search(sought, middle);
}

/// Whether the signal approaches zero on one side of it, by half or more.
bool SignalExtremes::nears_zero(const Sought &sought, int middle) const
{
  double nearest = std::numeric_limits<double>::infinity(), farthest = 0.;
  for (int k = middle - 1; k <= middle + 1; ++k)
  {
    const double below = -sought.sign * samples_[k].values[sought.signal];
    nearest            = std::min(nearest, below);
    farthest           = std::max(farthest, below);
  }
  return nearest > 0. && nearest < 0.5 * farthest;
}

/// The maximum of what is sought on the dense output, by parabolas that close in on it.
void SignalExtremes::search(const Sought &sought, int middle)
{
  std::array<Point, 3> p;
  for (int k = 0; k < 3; ++k)
    p[k] = {samples_[middle - 1 + k].t, sought.of(samples_[middle - 1 + k].values[sought.signal])};
  const double close = 1e-6 * (p[2].t - p[0].t);
  Point        top;
  for (int k = 0; k < 8 && maximum(p[0], p[1], p[2], top); ++k)
  {
    if (top.t < samples_[begin_].t)
      return; // in the previous step, already searched
    // A peak that seems to be outside is searched at the end, from inside.
    if (top.t >= p[2].t)
      top.t = 0.25 * p[1].t + 0.75 * p[2].t;
    else if (top.t <= p[0].t)
      top.t = 0.25 * p[1].t + 0.75 * p[0].t;
    const bool found = std::any_of(p.begin(), p.end(), [&](const Point &x) { return std::abs(x.t - top.t) < close; });
    if (found)
      return;
    run_.evaluate(top.t, probe_);
    top.f = sought.of(probe_.values[sought.signal]);
    see(probe_);
    // The end that is farther away gives place.
    p[top.t - p[0].t > p[2].t - top.t ? 0 : 2] = top;
    std::sort(p.begin(), p.end(), [](const Point &x, const Point &y) { return x.t < y.t; });
  }
}

void SignalSample::exchange(StateArchive &archive)
{
  archive(t, values);
}

void SignalExtremes::exchange(StateArchive &archive)
{
  archive(samples_, watched_, anew_, n_, begin_, open_);
}

} // namespace gestell::coupling
