#include "apps/analysis/spectra/order_tracking.h"

#include "apps/analysis/spectra/waterfall.h"
#include "coupling/integration/system/dense_solvers.h"
#include "fem/values/two_pi.h"

#include <algorithm>
#include <cmath>

namespace gestell::apps
{

namespace
{

constexpr int window_turns    = 4;  ///< separate orders 1/4 apart, while a run-up changes little
constexpr int most_orders     = 8;  ///< chosen: curves of one chart
constexpr int samples_of_turn = 64; ///< eight in a period of the highest order

/// Interpolates a table of values y over ascending x by the cubic through four neighbours.
double interpolated(const std::vector<double> &x, const std::vector<double> &y, double at)
{
  const auto        upper = std::upper_bound(x.begin(), x.end(), at) - x.begin();
  const std::size_t first = std::size_t(std::clamp<std::ptrdiff_t>(upper - 2, 0, std::ptrdiff_t(x.size()) - 4));
  double            sum   = 0.;
  for (std::size_t i = first; i < first + 4; ++i)
  {
    double basis = y[i];
    for (std::size_t j = first; j < first + 4; ++j)
      if (j != i)
        basis *= (at - x[j]) / (x[i] - x[j]);
    sum += basis;
  }
  return sum;
}

std::vector<double> column(const coupling::RunResult &run, std::size_t i)
{
  std::vector<double> values;
  for (std::size_t at = i; at < run.rows.size(); at += run.columns.size())
    values.push_back(run.rows[at]);
  return values;
}

/// A rotor, and the column with its angle or its speed.
struct Reference
{
  std::string rotor;
  std::size_t column   = 0;
  bool        is_angle = true;
};

std::optional<Reference> reference_of(const Scene &scene, const coupling::RunResult &run)
{
  for (const char *motion : {".angle", ".speed"})
    for (const SignalRequest &signal : scene.signals)
      for (const BodyRequest &body : scene.bodies)
        if (body.kind == coupling::BodyKind::rotor && signal.path == body.name + motion)
          if (const auto found = std::find(run.columns.begin(), run.columns.end(), signal.name);
              found != run.columns.end())
            return Reference{body.name, std::size_t(found - run.columns.begin()), std::string(motion) == ".angle"};
  return std::nullopt;
}

/// The history of a rotor that rotates in one direction; rows of equal time, as at events, are used once.
struct Turning
{
  std::vector<std::size_t> rows;
  std::vector<double>      t, angle; ///< angle from 0 on [rad], ascending
};

Turning turning(const coupling::RunResult &run, const Reference &reference)
{
  const std::vector<double> t = column(run, 0), reported = column(run, reference.column);
  std::vector<double>       angle = reported;
  if (!reference.is_angle) // trapezoids: as good as the rows are close
    for (std::size_t i = 0; i < t.size(); ++i)
      angle[i] = i == 0 ? 0. : angle[i - 1] + 0.5 * (reported[i] + reported[i - 1]) * (t[i] - t[i - 1]);
  const double sense = angle.empty() || angle.back() >= angle.front() ? 1. : -1.;
  Turning      result;
  for (std::size_t i = 0; i < t.size(); ++i)
  {
    const double phi = sense * (angle[i] - angle[0]);
    if (!result.t.empty() && t[i] <= result.t.back())
      continue;
    if (!result.t.empty() && phi <= result.angle.back())
      return {}; // it stops or reverses
    result.rows.push_back(i);
    result.t.push_back(t[i]);
    result.angle.push_back(phi);
  }
  return result;
}

/// [1/min] at the rows, by differences of the angle over a quarter of a revolution.
std::vector<double> speeds_of(const Turning &history)
{
  std::vector<double> speeds;
  for (std::size_t i = 0; i < history.t.size(); ++i)
  {
    const double begin = std::max(history.angle[i] - 0.125 * two_pi, 0.),
                 end   = std::min(history.angle[i] + 0.125 * two_pi, history.angle.back());
    speeds.push_back(60. / two_pi * (end - begin) /
                     (interpolated(history.angle, history.t, end) - interpolated(history.angle, history.t, begin)));
  }
  return speeds;
}

/// Smallest number of rows in any revolution.
double rows_of_turn(const Turning &history)
{
  double longest = 0.;
  for (std::size_t i = 1; i < history.angle.size(); ++i)
    longest = std::max(longest, history.angle[i] - history.angle[i - 1]);
  return two_pi / longest;
}

/// Rows that give the coefficients of cos and sin of each order from the samples of a window: weighted least squares of
/// these functions and a parabola, which approximates most signals of a run-up.
Eigen::MatrixXd order_fit(int n_orders)
{
  const int       n = window_turns * samples_of_turn;
  Eigen::MatrixXd A(n, 3 + 2 * n_orders);
  Eigen::VectorXd weights(n);
  for (int i = 0; i < n; ++i)
  {
    const double share = (i + 0.5) / n, s = 2. * share - 1., phi = two_pi * i / samples_of_turn;
    weights[i] = 0.5 - 0.5 * std::cos(two_pi * share);
    A.row(i).head<3>() << 1., s, s * s;
    for (int k = 1; k <= n_orders; ++k)
      A.row(i).segment<2>(1 + 2 * k) << std::cos(k * phi), std::sin(k * phi);
  }
  const Eigen::MatrixXd weighted = A.transpose() * weights.asDiagonal();
  return coupling::lu_solution(weighted * A, weighted).bottomRows(2 * n_orders);
}

/// Instants at equal angles, by windows.
std::vector<std::vector<double>> windows_of(const Turning &history, int turns)
{
  constexpr int                    most_windows = 400; // points of a curve that is 640 pixels wide
  const int                        hop          = std::max(1, turns / most_windows);
  std::vector<std::vector<double>> windows;
  for (int first = 0; first + window_turns <= turns; first += hop)
  {
    windows.emplace_back();
    for (int i = 0; i <= window_turns * samples_of_turn; ++i)
      windows.back().push_back(interpolated(history.angle, history.t, two_pi * (first + double(i) / samples_of_turn)));
  }
  return windows;
}

OrderedSignal ordered(const std::string &name, const std::string &unit, const Turning &history,
                      const std::vector<double> &y, const std::vector<std::vector<double>> &windows,
                      const Eigen::MatrixXd &fit)
{
  OrderedSignal   signal{name, unit, std::vector<std::vector<double>>(std::size_t(fit.rows() / 2))};
  Eigen::VectorXd samples(fit.cols());
  for (const std::vector<double> &times : windows)
  {
    for (Eigen::Index i = 0; i < samples.size(); ++i)
      samples[i] = interpolated(history.t, y, times[std::size_t(i)]);
    const Eigen::VectorXd found = fit * samples;
    for (std::size_t k = 0; k < signal.amplitudes.size(); ++k)
      signal.amplitudes[k].push_back(found.segment<2>(2 * Eigen::Index(k)).norm());
  }
  return signal;
}

/// Orders and spectra of every signal but the rotor's own.
void add_signals(const Scene &scene, const coupling::RunResult &run, const Reference &reference, const Turning &history,
                 const std::vector<std::vector<double>> &windows, OrderTracking &result)
{
  const Eigen::MatrixXd     fit     = order_fit(int(result.orders.size()));
  const std::vector<double> speeds  = speeds_of(history);
  const double              highest = most_orders / 60. * *std::max_element(speeds.begin(), speeds.end());
  for (const SignalRequest &request : scene.signals)
  {
    const std::size_t i =
        std::size_t(std::find(run.columns.begin(), run.columns.end(), request.name) - run.columns.begin());
    if (i >= run.columns.size() || i == reference.column)
      continue;
    const std::vector<double> all = column(run, i);
    std::vector<double>       own;
    for (const std::size_t row : history.rows)
      own.push_back(all[row]);
    result.signals.push_back(ordered(request.name, run.units[i], history, own, windows, fit));
    Waterfall spectra = waterfall(request.name, run.units[i], {history.t, speeds}, own, highest);
    if (!spectra.amplitudes.empty())
      result.waterfalls.push_back(std::move(spectra));
  }
}

} // namespace

std::optional<OrderTracking> order_tracking(const Scene &scene, const coupling::RunResult &run)
{
  const auto reference = reference_of(scene, run);
  if (!reference)
    return std::nullopt;
  const Turning    history     = turning(run, *reference);
  const double     turns       = history.angle.empty() ? 0. : history.angle.back() / two_pi;
  constexpr double most_turns  = 1e9; // that an int counts
  constexpr int    least_turns = 16;  // four windows: fewer show no change over the speed
  if (!(turns >= least_turns) || turns > most_turns || history.t.size() < 4)
    return std::nullopt;
  // rows of a period: two are the limit of sampling, the third keeps off aliases
  constexpr double samples_of_order = 3.;
  const int        n_orders         = std::min(most_orders, int(rows_of_turn(history) / samples_of_order));
  if (n_orders < 1)
    return std::nullopt;

  OrderTracking result;
  result.rotor = reference->rotor;
  result.turns = window_turns;
  for (int order = 1; order <= n_orders; ++order)
    result.orders.push_back(order);
  const std::vector<std::vector<double>> windows = windows_of(history, int(turns));
  for (const std::vector<double> &times : windows)
  {
    result.t.push_back(times[times.size() / 2]);
    result.speed_rpm.push_back(60. * window_turns / (times.back() - times.front()));
  }
  add_signals(scene, run, *reference, history, windows, result);
  return result;
}

} // namespace gestell::apps
