#pragma once

#include "coupling/periodic/continuation.h"
#include "coupling/periodic/periodic_problem.h"
#include "tests/support/cubic_system.h"

#include <cmath>
#include <map>
#include <string>

namespace gestell::tests
{

/// Oscillators of tests/reference/numerics/periodic.
struct DuffingCase
{
  double zeta, beta, F, Omega;
};
/// x'' + 2 zeta x' + x + beta x^3 = F cos(Omega t)
inline const std::map<std::string, DuffingCase> duffing_cases = {{"duffing1", {0.05, 0.5, 0.3, 1.4}},
                                                                 {"duffing2", {0.02, -0.05, 0.1, 0.9}},
                                                                 {"duffing3", {0.05, 1.0, 0.8, 0.45}},
                                                                 {"duffing4", {0.005, 0.02, 0.03, 1.03}}};

inline CubicSystem duffing_system(const DuffingCase &given)
{
  const Eigen::MatrixXd one = Eigen::MatrixXd::Identity(1, 1);
  CubicSystem           system(one, 2. * given.zeta * one, one, {{given.beta, Eigen::VectorXd::Ones(1)}});
  system.loads().add_harmonic(0, given.Omega, given.F, 0.);
  return system;
}

/// M q'' + B q' + C q + sum beta w (w^T q)^3 = F cos(Omega t)
inline CubicSystem two_dof_system(const std::string &name, double Omega)
{
  Eigen::MatrixXd M(2, 2), B(2, 2), C(2, 2);
  if (name == "two_dof1")
  {
    M << 1., 0., 0., 0.05;
    B << 0.015, -0.013, -0.013, 0.013;
    C << 1.0453, -0.0453, -0.0453, 0.0453;
    CubicSystem system(M, B, C, {{1., Eigen::Vector2d(1., 0.)}, {0.0042, Eigen::Vector2d(1., -1.)}});
    system.loads().add_harmonic(0, Omega, 0.11, 0.);
    return system;
  }
  M << 2., 0., 0., 1.;
  B << 0.06, -0.02, -0.02, 0.04;
  C << 3., -1., -1., 2.;
  CubicSystem system(M, B, C, {{0.5, Eigen::Vector2d(1., 0.)}});
  system.loads().add_harmonic(0, Omega, 0.8, 0.);
  return system;
}

/// x'' + 2 zeta x' + g(x) = F0 + F cos(Omega t), g a dead zone of half width 1 with unit slope: the base has no
/// stiffness at all.
struct ClearanceCase
{
  double zeta, F0, F, Omega;
};
inline const std::map<std::string, ClearanceCase> clearance_cases = {{"clearance1", {0.05, 0.3, 1., 0.7}},
                                                                     {"clearance2", {0.05, 0.3, 0.5, 1.8}},
                                                                     {"clearance3", {0.05, 0.1, 2., 1.8}},
                                                                     {"clearance4", {0.1, 0.3, 1., 1.8}}};

inline SmallSystem clearance_system(const ClearanceCase &given)
{
  const Eigen::MatrixXd one = Eigen::MatrixXd::Identity(1, 1);
  SmallSystem           system(one, 2. * given.zeta * one, 0. * one);
  system.set_law(Eigen::VectorXd::Ones(1),
                 [](double u, double, double &p, double &dp_du, double &dp_dv)
                 {
                   const bool touches = std::abs(u) > 1.;
                   p                  = touches ? (u > 0. ? 1. : -1.) - u : 0.;
                   dp_du              = touches ? -1. : 0.;
                   dp_dv              = 0.;
                 });
  system.loads().add_constant(0, given.F0);
  system.loads().add_harmonic(0, given.Omega, given.F, 0.);
  return system;
}

/// x'' + x = eps (1 - x^2) x'
inline SmallSystem van_der_pol(double eps)
{
  const Eigen::MatrixXd one = Eigen::MatrixXd::Identity(1, 1);
  SmallSystem           system(one, 0. * one, one);
  system.set_law(Eigen::VectorXd::Ones(1),
                 [eps](double u, double v, double &p, double &dp_du, double &dp_dv)
                 {
                   p     = eps * (1. - u * u) * v;
                   dp_du = -2. * eps * u * v;
                   dp_dv = eps * (1. - u * u);
                 });
  return system;
}

inline coupling::PeriodicProblem problem_of_period(coupling::SecondOrderSystem &system, double period)
{
  coupling::PeriodicProblem problem;
  problem.system = &system;
  problem.period = period;
  problem.turn   = Eigen::VectorXd::Zero(system.linear().size());
  return problem;
}

/// A branch from one value of its parameter to another.
inline coupling::ContinuationOptions branch_options(double from, double to, int points)
{
  coupling::ContinuationOptions options;
  options.from   = from;
  options.to     = to;
  options.points = points;
  return options;
}

} // namespace gestell::tests
