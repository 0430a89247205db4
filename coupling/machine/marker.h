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

/// A point on a body, on the frame or on the ground, with its small motion: translation [m] and rotation [rad] in
/// global x, y, z.  Joints, forces and sensors use markers, so that each can connect any two objects.
struct Marker
{
  std::string            name;
  std::array<Measure, 3> translation;
  std::array<Measure, 3> rotation;
  bool                   turns_freely = false; ///< free spatial body: no measure gives its rotation

  Measure along(const Vector3 &direction) const; ///< d . translation, with d normalised to a unit vector
  /// a . rotation, with a normalised to a unit vector.  @throws std::invalid_argument if turns_freely
  Measure about(const Vector3 &axis) const;
};

} // namespace gestell::coupling
