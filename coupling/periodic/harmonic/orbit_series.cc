#include "coupling/periodic/harmonic/orbit_series.h"

#include "coupling/periodic/harmonic/fourier_transform.h"

#include <cmath>
#include <complex>

namespace gestell::coupling
{

FourierSeries orbit_series(const PeriodicProblem &problem, PeriodFlow &flow, const Eigen::VectorXd &q,
                           const Eigen::VectorXd &v, double period, int harmonics)
{
  constexpr int          least = 256, share = 8; // samples for each harmonic
  const FourierTransform transform(power_of_two(std::max(least, share * harmonics)));
  const int              N = transform.samples();
  Eigen::MatrixXd        samples(N + 1, q.size());
  int                    k = 0;
  flow.look_on(N,
               [&](const OrbitPoint &point)
               {
                 if (k <= N)
                   samples.row(k++) = point.q;
               });
  flow.pass(q, v, period, false);
  flow.look_on(0, {});

  FourierSeries series;
  series.omega  = 2. * M_PI / period;
  series.begin  = problem.begin;
  series.ramp   = problem.turn.size() ? Eigen::VectorXd(problem.turn / period) : Eigen::VectorXd::Zero(q.size());
  series.cosine = Eigen::MatrixXd::Zero(q.size(), harmonics + 1);
  series.sine   = series.cosine;
  const Eigen::VectorXd line = Eigen::VectorXd::LinSpaced(N + 1, 0., 1.);
  Eigen::VectorXcd      c;
  for (Eigen::Index i = 0; i < q.size(); ++i)
  {
    const Eigen::VectorXd closed = samples.col(i) - (samples(N, i) - samples(0, i)) * line;
    transform.coefficients(closed.data(), c);
    for (int h = 0; h <= harmonics; ++h)
    {
      const std::complex<double> turned = c[h] * std::exp(std::complex<double>(0., -h * series.omega * series.begin));
      series.cosine(i, h)               = (h == 0 ? 1. : 2.) * turned.real();
      series.sine(i, h)                 = (h == 0 ? 0. : -2.) * turned.imag();
    }
  }
  return series;
}

} // namespace gestell::coupling
