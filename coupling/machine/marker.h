#pragma once

#include <array>
#include <string>
#include <utility>
#include <vector>

namespace gestell::coupling
{

using Vector3 = std::array<double, 3>;

/// A scalar measure of the motion, u = w . q, as pairs (coordinate of the machine, weight).  Empty: always zero.
using Measure = std::vector<std::pair<int, double>>;

Measure operator+(const Measure &a, const Measure &b);
Measure operator-(const Measure &a, const Measure &b);
Measure operator*(double s, const Measure &a);

/// A place on a body, on the frame or on the ground, by its small motion: translation [m] and rotation [rad] in global
/// x, y, z.  Joints, forces and sensors are written against markers, so each works between any two partners.
struct Marker
{
  std::string            name;
  std::array<Measure, 3> translation;
  std::array<Measure, 3> rotation;
  bool                   turns_freely = false; ///< in space, so that no measure tells its rotation

  Measure along(const Vector3 &direction) const; ///< d . translation, d made a unit vector
  /// a . rotation, a made a unit vector.  @throws std::invalid_argument if it turns freely
  Measure about(const Vector3 &axis) const;
};

} // namespace gestell::coupling
