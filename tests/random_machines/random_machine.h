#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace gestell::tests
{

/// What is known of a friction that truly sticks: |force| <= holding + viscous |v|, and while it slides
/// force = sign(v) [sliding + (holding - sliding) exp(-(v/stribeck_speed)^exponent)] + viscous v, v = rate - belt.
struct FrictionFact
{
  std::string name; ///< signals "NAME.force", "NAME.rate"
  double      holding = 0., sliding = 0., belt = 0., stribeck_speed = 0., exponent = 1., viscous = 0.;
  bool        engaged = true; ///< always; else its forces are a share of these
};

/// A contact that pushes: force * side >= 0; side 0: the sign is that of the displacement.
struct ContactFact
{
  std::string name; ///< signals "NAME.force", "NAME.displacement"
  int         side  = 1;
  bool        loses = false; ///< energy: bodies that part fast are not pushed
};

/// Two points, one on either body, that a joint holds together.
struct PinFact
{
  std::string           joint;
  std::string           a, b;      ///< places, signals "a.x" ...; a empty: at `x` of the ground
  std::vector<char>     axes;      ///< 'x' ... along which they stay together
  double                size = 1.; ///< [m] of the machine
  std::array<double, 3> x{};       ///< [m]
};

class Twin;

/// A scene, and what must hold of its motion.
struct RandomMachine
{
  std::uint64_t                      seed = 0;
  std::string                        kind;    ///< in words
  std::string                        scene;   ///< TOML without [run] and [output]
  std::map<std::string, std::string> files;   ///< beside it
  std::vector<std::string>           signals; ///< paths
  std::map<std::string, double>      sizes;   ///< of signals of another kind
  std::vector<FrictionFact>          frictions;
  std::vector<ContactFact>           contacts;
  std::vector<PinFact>               pins;
  std::shared_ptr<const Twin>        twin; ///< its equations by another formulation, where they are known

  double period = 1.;                                    ///< [s] of the slow motion
  double end    = 1.;                                    ///< [s]
  double length = 1., speed = 1., force = 1.;            ///< of the motion [m or rad, ...]
  double fall_length = 0., fall_speed = 0., weight = 0.; ///< of what is released; levels of switches do not count them
  bool   jointed      = false;
  bool   bdf_only     = false; ///< a law has a state without mass
  bool   accelerated  = false; ///< forces depend on accelerations
  bool   closed_start = false; ///< its start values depend on each other, as joints close with them alone
  bool   wide         = false; ///< of the wider generator, with laws and ways that earlier seeds do not have
  bool   conservative = true;  ///< nothing dissipates and nothing drives
  bool   passive      = true;  ///< what its laws take up is never negative
  bool   linear       = true;  ///< springs, dampers and loads alone
  bool   loadless     = true;  ///< no force but of springs and dampers
};

/// The size of a signal in a machine that moves as its scale says; it may rest.
double size_of(const RandomMachine &machine, const std::string &signal);

/// The machine of a seed; the same on every computer.
RandomMachine random_machine(std::uint64_t seed);

} // namespace gestell::tests
