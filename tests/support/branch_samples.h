#pragma once

#include "mechanism/elements/clearance.h"
#include "mechanism/elements/connecting_rod.h"
#include "mechanism/elements/journal_bearing.h"
#include "tests/support/element_probe.h"

#include <cmath>

namespace gestell::tests
{

using namespace mechanism;

const inline ConnectingRod::Parameters rod{0.08, 0.8, 9e8, 1.8e5, 1e-4, 4e-4, 5e4};
const inline Clearance::Parameters     play{5e-5, 1e9, 4.};

const inline SlidingFriction            rubbing{0.1, 2e-2, 0.2, 0.05, 1.};
const inline JournalBearing::Parameters bearing{5e-5, 0.03, 1e9, 4., 1., rubbing};

inline double rod_position(double phi)
{
  const double c = rod.crank_radius * std::sin(phi);
  return -rod.crank_radius * std::cos(phi) + std::sqrt(rod.length * rod.length - c * c) -
         (rod.length - rod.crank_radius);
}

/// The rod with the compression delta at its rate, the crank nearly at rest.
inline Probe rod_probe(double delta, double rate)
{
  const double phi = 2.5;
  return {0., Eigen::Vector3d(phi, delta - rod_position(phi), 0.), Eigen::Vector3d(1e-3, rate, 0.),
          Eigen::Vector3d::Zero()};
}

} // namespace gestell::tests
