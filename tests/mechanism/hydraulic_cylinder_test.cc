// Oil of both chambers of a cylinder: none is lost, and closed columns are springs.

#include "mechanism/elements/hydraulic_cylinder.h"
#include "tests/support/element_probe.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

using namespace mechanism;

HydraulicCylinder::Parameters unlike_chambers()
{
  HydraulicCylinder::Parameters P;
  P.area_a     = 2e-3;
  P.area_b     = 1.2e-3;
  P.volume_a   = 6e-4;
  P.volume_b   = 4e-4;
  P.pressure_a = 5e6;
  P.pressure_b = 3e6;
  P.zero       = 0.01;
  return P;
}

Probe oil(double u, double a, double b)
{
  return {0., Eigen::Vector3d(u, a, b), Eigen::Vector3d(0.1, 0., 0.), Eigen::Vector3d::Zero()};
}

/// Flow into a chamber, Q = A a' exp[-(p - p_0)/K], from the input p_i of its virtual coordinate.
double flow(const HydraulicCylinder &cylinder, const HydraulicCylinder::Parameters &P, const Probe &probe, int chamber)
{
  const Eigen::VectorXd history = started(cylinder, probe);
  const Eigen::VectorXd p       = force(cylinder, probe, history.data());
  const double          rate    = (p[chamber] - probe.u[chamber]) / HydraulicCylinder::lag;
  const double          pressed =
      cylinder.quantity(chamber, probe.motion(), history.data()) - (chamber == 1 ? P.pressure_a : P.pressure_b);
  return (chamber == 1 ? P.area_a : P.area_b) * rate * std::exp(-pressed / P.bulk_modulus);
}

TEST(HydraulicCylinder, WhatLeaksOutOfOneChamberComesIntoTheOther)
{
  auto P    = unlike_chambers();
  P.leakage = 2e-12;
  const HydraulicCylinder cylinder(P);
  for (const Probe &probe : {oil(0.012, 0.004, -0.001), oil(0.012, -0.002, 0.003)})
  {
    const Eigen::VectorXd history = started(cylinder, probe);
    const double          drop =
        cylinder.quantity(1, probe.motion(), history.data()) - cylinder.quantity(2, probe.motion(), history.data());
    EXPECT_NEAR(flow(cylinder, P, probe, 1), -2e-12 * drop, 1e-10 * 2e-12 * std::abs(drop));
    EXPECT_NEAR(flow(cylinder, P, probe, 2), 2e-12 * drop, 1e-10 * 2e-12 * std::abs(drop));
  }
}

TEST(HydraulicCylinder, ACommandedFlowTakesOutWhatThePistonPushes)
{
  auto P   = unlike_chambers();
  P.course = 3e-4;
  const HydraulicCylinder cylinder(P);
  const Probe             probe = oil(0.02, 0.004, -0.001);
  EXPECT_NEAR(flow(cylinder, P, probe, 1), 3e-4, 1e-14);
  EXPECT_NEAR(flow(cylinder, P, probe, 2), -3e-4 * 1.2 / 2., 1e-14);
}

// K (A^2/V_a + B^2/V_b) with the volumes at the stroke, which is the slope of the force at oil that is held.
TEST(HydraulicCylinder, IsASpringOfItsClosedColumnsAtAnyStroke)
{
  const HydraulicCylinder cylinder(unlike_chambers());
  for (const double x : {-0.2, 0., 0.25})
  {
    const Probe           probe    = oil(0.01 + x, x, -x);
    const Eigen::VectorXd history  = started(cylinder, probe);
    const double          volume_a = 6e-4 + 2e-3 * x, volume_b = 4e-4 - 1.2e-3 * x;
    const double          K        = 1.4e9 * (2e-3 * 2e-3 / volume_a + 1.2e-3 * 1.2e-3 / volume_b);
    Eigen::Matrix3d       reported = Eigen::Matrix3d::Zero(), lost = reported, of_u, of_v;
    Eigen::Vector3d       p;
    cylinder.engaged(probe.u.data(), reported.data(), lost.data());
    cylinder.derivatives(probe.motion(), history.data(), p.data(), of_u.data(), of_v.data());
    EXPECT_NEAR(reported(0, 0), K, 1e-12 * K) << x;
    EXPECT_NEAR(-of_u(0, 0), K, 1e-12 * K) << x;
  }
}

} // namespace
} // namespace gestell::tests
