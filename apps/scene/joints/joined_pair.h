#pragma once

#include "apps/scene/values/requests.h"
#include "coupling/machine/machine.h"
#include "mechanism/measures/relative_measure.h"

#include <vector>

namespace gestell::apps
{

inline mechanism::Vector3d vector(const Vector3 &a)
{
  return {a[0], a[1], a[2]};
}
Vector3               point_of(const coupling::MachineModel &machine, const PlaceRequest &place);
coupling::PlacedPoint placed(const coupling::MachineModel &machine, const PlaceRequest &place);

/// Two points with the measures of both.
struct Pair
{
  Pair(const coupling::MachineModel &machine, const PlaceRequest &from, const PlaceRequest &to);

  const coupling::Body *planar() const;    ///< one of the two, if it is planar
  bool                  in_space() const;  ///< one of the two is a free spatial body
  bool                  has_point() const; ///< one of the two is a point without rotation
  double                size() const;      ///< [m] of the numbers that define the points
  double                at_start(const mechanism::RelativeMeasure &measure) const; ///< in the reference configuration
  /// Whether some motion of the two bodies changes it by more than rounding; only coordinates of the machine with index
  /// >= `from`.
  bool                             moves(const mechanism::RelativeMeasure &measure, int from = 0) const;
  std::vector<mechanism::Vector3d> own_axes() const;   ///< axes of rotors and planar bodies
  std::vector<mechanism::Vector3d> fixed_axes() const; ///< axes of rotors, directions of sliders

  mechanism::Placement           first, second;
  std::vector<coupling::Measure> measures;
  const coupling::Body          *on_first = nullptr, *on_second = nullptr;
  int                            n_frame; ///< number of frame coordinates, the first ones of the machine
};

/// Largest possible gradient of an equation with measure i: of a length by the lever, of an angle by the rotation.
double largest_gradient(const Pair &pair, const mechanism::RelativeMeasure &measure, int i);

/// Motion k of three random ones, as large as the bodies: an equation that none changes is not changed by any motion.
void sample_motion(int k, const Pair &pair, double *u);

/// Gradient below which no motion of the two bodies changes an equation, relative to the largest possible one: motions
/// as large as the bodies change it by less than the assembly tolerance of joints [m].
constexpr double immobile = 1e-10;

} // namespace gestell::apps
