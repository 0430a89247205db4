#pragma once

#include "coupling/machine/machine.h"
#include "mechanism/elements/coulomb_friction.h"
#include "mechanism/elements/cubic_spring.h"
#include "mechanism/joints/ideal_joint.h"
#include "mechanism/transmitted_element.h"

#include <cmath>
#include <memory>
#include <string>

namespace gestell::tests
{

/// Mechanisms in the plane z = 0 with ideal joints, of the reference tables in tests/reference/numerics/dae.
using coupling::Machine;
using coupling::MachineModel;
using coupling::Vector3;
using mechanism::RelativeMeasure;
using mechanism::Vector3d;

struct PlanePoint
{
  double  x = 0., y = 0.;
  Vector3 vector() const { return {x, y, 0.}; }
};

inline PlanePoint operator+(const PlanePoint &a, const PlanePoint &b)
{
  return {a.x + b.x, a.y + b.y};
}

inline int add_planar(MachineModel &machine, const std::string &name, double mass, double inertia,
                      const PlanePoint &centre)
{
  return machine.add_planar(name, {0., 0., 1.}, mass, inertia, centre.vector());
}

inline void add_joint(MachineModel &machine, const std::string &name, const std::string &from, const std::string &to,
                      const PlanePoint &at, const std::vector<mechanism::IdealJoint::Equation> &equations)
{
  const auto first = machine.place(from, at.vector()), second = machine.place(to, at.vector());
  auto       measures = first.measures;
  measures.insert(measures.end(), second.measures.begin(), second.measures.end());
  machine.attach(name, std::make_shared<mechanism::IdealJoint>(first.placement, second.placement, equations), measures);
}

inline mechanism::IdealJoint::Equation along(const std::string &name, const Vector3d &a)
{
  mechanism::IdealJoint::Equation equation;
  equation.name      = name;
  equation.measure.a = a;
  return equation;
}

/// `to` is held at the point `at` of `from`; fx, fy act on `to`.
inline void revolute(MachineModel &machine, const std::string &name, const std::string &from, const std::string &to,
                     const PlanePoint &at)
{
  add_joint(machine, name, from, to, at, {along("fx", Vector3d::UnitX()), along("fy", Vector3d::UnitY())});
}

/// Spring of stiffness c and free length l0 between two points.
inline void spring(MachineModel &machine, const std::string &name, const std::string &from, const PlanePoint &at_from,
                   const std::string &to, const PlanePoint &at_to, double c, double l0)
{
  const auto first = machine.place(from, at_from.vector()), second = machine.place(to, at_to.vector());
  auto       measures = first.measures;
  measures.insert(measures.end(), second.measures.begin(), second.measures.end());
  RelativeMeasure distance;
  distance.form = RelativeMeasure::Form::distance;
  mechanism::CubicSpring::Parameters law;
  law.stiffness = c;
  machine.attach(name,
                 std::make_shared<mechanism::TransmittedElement>(
                     mechanism::PlacedMeasure{first.placement, second.placement, distance},
                     std::make_shared<mechanism::CubicSpring>(law), l0),
                 measures);
}

/// A01: a point of 1 kg on a rod of 1 m, level at first; "rod.force" is the push, minus the tension.
inline Machine pendulum()
{
  MachineModel model;
  model.set_gravity({0., -9.81, 0.});
  model.add_point("bob", 1., {-1., 0., 0.});
  const auto                      ground = model.place("ground", {0., 0., 0.}), bob = model.place("bob", {-1., 0., 0.});
  mechanism::IdealJoint::Equation rod;
  rod.name         = "force";
  rod.measure.form = RelativeMeasure::Form::distance;
  rod.offset       = 1.;
  model.attach("rod",
               std::make_shared<mechanism::IdealJoint>(ground.placement, bob.placement,
                                                       std::vector<mechanism::IdealJoint::Equation>{rod}),
               bob.measures);
  return Machine(std::move(model));
}

/// A02: N windows of uniform rods, 1 kg and 1 m each, upright; body "crank i" i = 0..N, "coupler i" i = 1..N.
inline Machine n_four_bar(int N)
{
  MachineModel model;
  model.set_gravity({0., -9.81, 0.});
  const double J = 1. / 12.;
  for (int i = 0; i <= N; ++i)
  {
    const std::string crank = "crank " + std::to_string(i);
    add_planar(model, crank, 1., J, {double(i), 0.5});
    revolute(model, "foot " + std::to_string(i), "ground", crank, {double(i), 0.});
  }
  for (int i = 1; i <= N; ++i)
  {
    const std::string coupler = "coupler " + std::to_string(i), left = "crank " + std::to_string(i - 1);
    add_planar(model, coupler, 1., J, {i - 0.5, 1.});
    revolute(model, "left " + std::to_string(i), left, coupler, {i - 1., 1.});
    revolute(model, "right " + std::to_string(i), coupler, "crank " + std::to_string(i), {double(i), 1.});
  }
  return Machine(std::move(model));
}

/// Velocities of A02 at its begin: the upper ends of the upright rods move at 1 m/s.
inline Eigen::VectorXd swinging_four_bars(const Machine &machine)
{
  Eigen::VectorXd v = Eigen::VectorXd::Zero(machine.size());
  for (const auto &body : machine.model().bodies())
  {
    const bool crank       = body.name[1] == 'r';
    v[body.coordinate]     = crank ? 0.5 : 1.;
    v[body.coordinate + 2] = crank ? -1. : 0.;
  }
  return v;
}

/// A03: Andrews' squeezer in its start position, driven by 0.033 N m.
inline Machine andrews_squeezer()
{
  const double m[] = {.04325, .00365, .02373, .00706, .07050, .00706, .05498},
               I[] = {2.194e-6, 4.410e-7, 5.255e-6, 5.667e-7, 1.169e-5, 5.667e-7, 1.912e-5};
  const double xa = -.06934, ya = -.00227, xb = -.03635, yb = .03273, xc = .014, yc = .072, d = .028, da = .0115,
               e = .02, ea = .01421, rr = .007, ra = .00092, sa = .01874, sb = .01043, sc = .018, sd = .02, ta = .02308,
               tb = .00916, u = .04, ua = .01228, ub = .00449, zf = .02, zt = .04, fa = .01421;
  const double beta = -0.0617138900142764496358948458001, Theta = 0., gamma = 0.455279819163070380255912382449,
               Phi = 0.222668390165885884674473185609, delta = 0.487364979543842550225598953530, Omega = -Phi,
               epsilon = 1.23054744454982119249735015568;
  const auto       c   = [](double x) { return std::cos(x); };
  const auto       s   = [](double x) { return std::sin(x); };
  const PlanePoint O{}, A{xa, ya}, B0{xb, yb}, C{xc, yc};
  const double     bT = beta + Theta, Pd = Phi + delta, Oe = Omega + epsilon;
  const PlanePoint pin{rr * c(beta), rr * s(beta)};
  const PlanePoint B{pin.x - d * c(bT), pin.y - d * s(bT)};
  const PlanePoint centres[] = {{ra * c(beta), ra * s(beta)},
                                {pin.x - da * c(bT), pin.y - da * s(bT)},
                                {xb + sa * s(gamma) + sb * c(gamma), yb - sa * c(gamma) + sb * s(gamma)},
                                {xa + zt * c(delta) + (e - ea) * s(Pd), ya + zt * s(delta) - (e - ea) * c(Pd)},
                                {xa + ta * c(delta) - tb * s(delta), ya + ta * s(delta) + tb * c(delta)},
                                {xa + u * s(epsilon) + (zf - fa) * c(Oe), ya - u * c(epsilon) + (zf - fa) * s(Oe)},
                                {xa + ua * s(epsilon) - ub * c(epsilon), ya - ua * c(epsilon) - ub * s(epsilon)}};
  MachineModel     model;
  for (int i = 0; i < 7; ++i)
    add_planar(model, "K" + std::to_string(i + 1), m[i], I[i], centres[i]);
  revolute(model, "O", "ground", "K1", O);
  revolute(model, "pin", "K1", "K2", pin);
  revolute(model, "B0", "ground", "K3", B0);
  revolute(model, "A5", "ground", "K5", A);
  revolute(model, "A7", "ground", "K7", A);
  revolute(model, "F", "K5", "K4", A + PlanePoint{zt * c(delta), zt * s(delta)});
  revolute(model, "H", "K7", "K6", A + PlanePoint{u * s(epsilon), -u * c(epsilon)});
  revolute(model, "B23", "K3", "K2", B);
  revolute(model, "B24", "K4", "K2", B);
  revolute(model, "B26", "K6", "K2", B);
  spring(model, "spring", "K3", B0 + PlanePoint{sc * s(gamma) + sd * c(gamma), -sc * c(gamma) + sd * s(gamma)},
         "ground", C, 4530., .07785);
  model.add_load("motor", model.marker("K1").about({0., 0., 1.}), 0.033, {}, "N m");
  return Machine(std::move(model));
}

struct SliderCrankParameters
{
  double r, l, m1, m2, m3, J1, J2, centre_1, centre_2, torque, phi;
};

inline SliderCrankParameters slider_crank_case(const std::string &name)
{
  if (name == "crank1")
    return {.15, .30, .38, .76, .76, 7.13e-4, 5.7e-3, .5, .5, 0., .7};
  return {.1, .45, 6., 4., 12., .01, .07, .2, .35, 25., .3};
}

/// Crank, rod and slider at the crank angle of the start; the slider is a point guided along x, with dry friction
/// [N m] on the crank of so much in motion and twelve times that at rest.
inline Machine slider_crank(const SliderCrankParameters &p, double friction = 0.)
{
  MachineModel model;
  model.set_gravity({0., -9.81, 0.});
  const double     psi = -std::asin(p.r * std::sin(p.phi) / p.l);
  const PlanePoint pin{p.r * std::cos(p.phi), p.r * std::sin(p.phi)};
  const PlanePoint end{pin.x + p.l * std::cos(psi), 0.};
  add_planar(model, "crank", p.m1, p.J1, {p.centre_1 * pin.x, p.centre_1 * pin.y});
  add_planar(model, "rod", p.m2, p.J2, {pin.x + p.centre_2 * (end.x - pin.x), pin.y + p.centre_2 * (end.y - pin.y)});
  model.add_point("slider", p.m3, end.vector());
  revolute(model, "bearing", "ground", "crank", {});
  revolute(model, "crank pin", "crank", "rod", pin);
  revolute(model, "slider pin", "slider", "rod", end);
  add_joint(model, "guide", "ground", "slider", end, {along("fy", Vector3d::UnitY()), along("fz", Vector3d::UnitZ())});
  if (p.torque != 0.)
    model.add_load("motor", model.marker("crank").about({0., 0., 1.}), p.torque, {}, "N m");
  if (friction > 0.)
    model.attach("brake",
                 std::make_shared<mechanism::CoulombFriction>(
                     mechanism::CoulombFriction::Parameters{friction, 12. * friction, 0.}),
                 {{{model.coordinate("crank.angle"), 1.}}});
  return Machine(std::move(model));
}

/// Its velocities for an angular velocity omega [rad/s] of the crank, slider guided.
inline Eigen::VectorXd slider_crank_velocity(const SliderCrankParameters &p, double omega)
{
  const double    psi      = -std::asin(p.r * std::sin(p.phi) / p.l);
  const double    psi_rate = -p.r * std::cos(p.phi) * omega / (p.l * std::cos(psi));
  const double    px = -p.r * std::sin(p.phi) * omega, py = p.r * std::cos(p.phi) * omega;
  const double    ex = px - p.l * std::sin(psi) * psi_rate;
  Eigen::VectorXd v(9);
  v << p.centre_1 * px, p.centre_1 * py, omega, px + p.centre_2 * (ex - px), py * (1. - p.centre_2), psi_rate, ex, 0.,
      0.;
  return v;
}

} // namespace gestell::tests
