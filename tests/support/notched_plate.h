#pragma once

#include "apps/analysis/life/damage/worst_points.h"

#include <cmath>
#include <random>

namespace gestell::tests
{

/// A plate with a notch: smooth fields of each coordinate, three times as large at the notch.
struct NotchedPlate
{
  coupling::ReducedStress      stress;
  std::vector<Eigen::Vector3d> position;
  Eigen::MatrixXd              states;

  NotchedPlate(int points, int samples, int n = 7)
  {
    std::mt19937                     random(4);
    std::normal_distribution<>       normal;
    std::uniform_real_distribution<> uniform;
    stress.mean.resize(6 * points, n);
    Eigen::MatrixXd x(3, points);
    for (int i = 0; i < points; ++i)
    {
      stress.point.push_back(i);
      stress.nearby.push_back(-1);
      x.col(i) << 2. * uniform(random), uniform(random), 0.;
      position.push_back(x.col(i));
    }
    for (int j = 0; j < n; ++j)
      for (int c = 0; c < 6; ++c)
      {
        const double kx = normal(random), ky = normal(random), phase = 3. * normal(random);
        const double size = c == 2 || c > 3 ? 0.1 : 1.;
        for (int i = 0; i < points; ++i)
        {
          const double notch        = 1. + 4. / (1. + 300. * (x.col(i) - Eigen::Vector3d(0.6, 0.4, 0.)).squaredNorm());
          stress.mean(6 * i + c, j) = float(notch * size * std::cos(kx * x(0, i) + ky * x(1, i) + phase));
        }
      }
    states.resize(n, samples);
    for (int j = 0; j < n; ++j) // impacts that ring, over a static stress
      for (int k = 0; k < samples; ++k)
      {
        const double t = double(k % (samples / 2)) / samples;
        states(j, k) =
            1e7 / (1 + j * j) * (1. + 2. * std::exp(-6. * t) * std::sin(2. * M_PI * 10. * std::pow(1.6, j) * t + j));
      }
  }

  apps::DamageSearch search(apps::StressMeasure measure, int worst) const
  {
    apps::DamageSearch search;
    search.measure  = measure;
    search.counts   = std::vector<char>(position.size(), 1);
    search.worst    = worst;
    search.position = position;
    if (measure != apps::StressMeasure::signed_von_mises)
      search.directions.assign(position.size(), {Eigen::Vector3d::UnitZ(), Eigen::Vector3d::UnitX()});
    return search;
  }

  apps::LoadSequence load(apps::Residue residue = apps::Residue::repeated) const
  {
    const auto n = std::int64_t(states.cols());
    return {{{0, n / 2, 20.}, {n / 2, n - 1, 3.}, {n - 1, n, 2.}}, residue}; // the last one a static load
  }
};

} // namespace gestell::tests
