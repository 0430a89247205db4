#include "apps/analysis/frf/response_sweep.h"

#include "fem/values/number_text.h"
#include "fem/values/two_pi.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace gestell::apps
{

namespace
{

using Complex = std::complex<double>;

const Complex unknown(std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::quiet_NaN());

/// Whether both are finite, and the phase changes much.
bool turns(Complex a, Complex b)
{
  // of a phase between adjacent frequencies: a mode changes it by pi, so that there are at least three steps
  constexpr double widest_turn = M_PI / 3.;
  return std::isfinite(std::abs(a)) && std::isfinite(std::abs(b)) && a != 0. && b != 0. &&
         std::abs(std::arg(b / a)) > widest_turn;
}

/// Adds frequencies of damped modes in the band, with points next to them.
void add_modes(const std::vector<coupling::Mode> &modes, std::vector<double> &frequencies)
{
  const double lowest = frequencies.front(), highest = frequencies.back();
  // ratio of a mode whose frequency is added to the given ones: less is rounding
  constexpr double least_damped = 1e-7;
  for (const coupling::Mode &mode : modes)
    if (mode.damping_ratio > least_damped && mode.damped_frequency_hz > 0.)
      for (const double nearby : {-2., -1., -0.5, 0., 0.5, 1., 2.})
        if (const double f = mode.damped_frequency_hz * (1. + nearby * mode.damping_ratio); f > lowest && f < highest)
          frequencies.push_back(f);
  std::sort(frequencies.begin(), frequencies.end());
  frequencies.erase(std::unique(frequencies.begin(), frequencies.end()), frequencies.end());
}

} // namespace

void ResponseSweep::add_force(const Eigen::VectorXd &force)
{
  forces_.conservativeResize(force.size(), forces_.cols() + 1);
  forces_.rightCols(1) = force;
}

void ResponseSweep::add_answer(const coupling::LinearAnswer &answer, int derivatives)
{
  answers_.push_back({answer, derivatives});
}

Complex ResponseSweep::value(const Answer &answer, const coupling::Vibration &vibration, Eigen::Index column) const
{
  const auto   q = vibration.q.col(column);
  const double s = vibration.omega, size = std::sqrt(masses_.dot(q.cwiseAbs2()));
  double       floor = 0.;
  for (Eigen::Index i = 0; i < q.size(); ++i)
  {
    const auto &[on_q, on_v, on_a, on_p, on_lambda] = answer.signal;
    const double     weight   = std::abs(on_q[i]) + s * std::abs(on_v[i]) + s * s * std::abs(on_a[i]);
    constexpr double rounding = 1e-12; // of a coordinate relative to the motion of all, in the metric of mass
    floor += masses_[i] > 0. ? rounding * weight * size / std::sqrt(masses_[i]) : 0.;
  }
  const Complex own = answer.signal.of(vibration, column);
  return std::abs(own) <= floor ? 0. : own * std::pow(Complex(0., s), answer.derivatives);
}

ResponseSweep::Sample ResponseSweep::at(double f) const
{
  Sample sample{f, std::vector<Complex>(std::size_t(forces_.cols()) * answers_.size(), unknown)};
  try
  {
    const coupling::Vibration vibration = machine_.at(two_pi * f, forces_);
    std::size_t               pair      = 0;
    for (Eigen::Index column = 0; column < forces_.cols(); ++column)
      for (const Answer &answer : answers_)
        sample.values[pair++] = value(answer, vibration, column);
  }
  catch (const coupling::ConvergenceFailure &)
  {
    // there is an undamped mode here
  }
  return sample;
}

double ResponseSweep::amplitude(std::size_t pair, double f) const
{
  const auto n      = answers_.size();
  const auto column = Eigen::Index(pair / n);
  try
  {
    const coupling::Vibration vibration = machine_.at(two_pi * f, forces_.col(column));
    return std::abs(value(answers_[pair % n], vibration, 0));
  }
  catch (const coupling::ConvergenceFailure &)
  {
    return std::numeric_limits<double>::infinity();
  }
}

std::vector<ResponseSweep::Sample> ResponseSweep::sampled(std::vector<double> frequencies) const
{
  std::vector<Sample> samples;
  for (const double f : frequencies)
    samples.push_back(at(f));
  return samples;
}

void ResponseSweep::add_between(std::vector<Sample> &samples) const
{
  constexpr int most_halves = 8; // a 256th of a step follows modes of that much less damping than the grid resolves
  for (int k = 0; k < most_halves; ++k)
  {
    std::vector<Sample> finer;
    for (std::size_t i = 0; i < samples.size(); ++i)
    {
      if (i > 0)
      {
        bool far = false;
        for (std::size_t pair = 0; pair < samples[i].values.size(); ++pair)
          far = far || turns(samples[i - 1].values[pair], samples[i].values[pair]);
        if (far)
          finer.push_back(at(0.5 * (samples[i - 1].f + samples[i].f)));
      }
      finer.push_back(samples[i]);
    }
    const bool done = finer.size() == samples.size();
    samples         = std::move(finer);
    if (done)
      return;
  }
}

void ResponseSweep::find_peaks(std::vector<Sample> &samples, FrequencyResponse &response) const
{
  std::vector<double> frequencies, tops;
  for (const Sample &sample : samples)
    frequencies.push_back(sample.f);
  for (std::size_t pair = 0; pair < response.pairs.size(); ++pair)
  {
    std::vector<double> amplitudes;
    for (const Sample &sample : samples)
    {
      const double own = std::abs(sample.values[pair]);
      amplitudes.push_back(std::isnan(own) ? std::numeric_limits<double>::max() : own);
    }
    response.pairs[pair].peaks =
        coupling::response_peaks([&](double f) { return amplitude(pair, f); }, frequencies, amplitudes);
    for (const coupling::ResponsePeak &peak : response.pairs[pair].peaks)
      if (std::isfinite(peak.amplitude))
        tops.push_back(peak.frequency_hz);
  }
  std::sort(tops.begin(), tops.end());
  tops.erase(std::unique(tops.begin(), tops.end(), [](double a, double b) { return b - a < 1e-6 * a; }), tops.end());
  const std::vector<Sample> own = sampled(tops);
  samples.insert(samples.end(), own.begin(), own.end());
  std::sort(samples.begin(), samples.end(), [](const Sample &a, const Sample &b) { return a.f < b.f; });
}

void ResponseSweep::run(const std::vector<double> &requested, const std::vector<coupling::Mode> &modes,
                        FrequencyResponse &response, std::vector<std::string> &warnings)
{
  std::vector<double> frequencies = requested;
  add_modes(modes, frequencies);
  std::vector<Sample> samples = sampled(frequencies);
  add_between(samples);
  find_peaks(samples, response);
  std::size_t driven = 0;
  for (const Sample &sample : samples)
  {
    response.frequencies_hz.push_back(sample.f);
    for (std::size_t pair = 0; pair < response.pairs.size(); ++pair)
      response.pairs[pair].values.push_back(sample.values[pair]);
    driven += std::isnan(std::abs(sample.values[0])) ? 1 : 0;
  }
  if (driven > 0)
    warnings.push_back("at " + count_text(driven, "frequency", "frequencies") +
                       " the machine has an undamped mode, so the response is infinite (listed as nan); add damping");
}

} // namespace gestell::apps
