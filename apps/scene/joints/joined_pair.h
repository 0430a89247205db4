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

/// Two places with the measures of both.
struct Pair
{
  Pair(const coupling::MachineModel &machine, const PlaceRequest &from, const PlaceRequest &to);

  const coupling::Body *planar() const;    ///< one of the two, if it is
  bool                  in_space() const;  ///< one of the two turns freely
  bool                  has_point() const; ///< one of the two has no rotation to compare with
  double                size() const;      ///< [m] of the numbers that say where the places are
  double                at_start(const mechanism::RelativeMeasure &measure) const; ///< in the position described
  /// Some motion of the two changes it by more than rounding; of coordinates of the machine from that one on.
  bool                             moves(const mechanism::RelativeMeasure &measure, int from = 0) const;
  std::vector<mechanism::Vector3d> own_axes() const;   ///< about which rotors and planar bodies turn
  std::vector<mechanism::Vector3d> fixed_axes() const; ///< about which rotors turn, along which sliders move

  mechanism::Placement           first, second;
  std::vector<coupling::Measure> measures;
  const coupling::Body          *on_first = nullptr, *on_second = nullptr;
  int                            n_frame; ///< coordinates of the frame, the first ones of the machine
};

/// Largest gradient that an equation could have in measure i: of a length by the lever, of an angle by the turn.
double largest_gradient(const Pair &pair, const mechanism::RelativeMeasure &measure, int i);

/// Motion k of three of no order, as large as the bodies: what changes in none of them changes in no motion.
void sample_motion(int k, const Pair &pair, double *u);

/// Gradient of an equation that no motion of the two bodies changes, as a share of the largest it could have: what
/// motions as large as the bodies are change by less than the assembly of a machine leaves joints open [m].
constexpr double immobile = 1e-10;

} // namespace gestell::apps
