#pragma once

#include "apps/scene/variant.h"
#include "apps/session/periodic_request.h"
#include "apps/session/reduced_frame_store.h"
#include "coupling/periodic/followed_equations.h"

#include <memory>
#include <string>
#include <vector>

namespace gestell::apps
{

/// A machine at one value of a scene key.
struct MachineMember : PreparedScene
{
  coupling::PeriodicProblem problem;
};

/// Rejects a parameter that the scene does not have, because an override would only create an unused key, and keys that
/// do not change the equations of motion, such as those of [run] and [output].
/// @throws std::invalid_argument with the key, its role, and suitable keys
void require_parameter(const Variant &file, const std::string &key);

/// A scene at varying values of one key, on a frame that is reduced only once.
class SceneFamily
{
public:
  /// @throws std::invalid_argument if the limits are not numbers of one unit, the key is unknown, or the key changes
  ///   the frame itself (with the cost of that)
  SceneFamily(Variant file, PreparedMachine &machine, const PeriodicRequest &request,
              const coupling::PeriodicProblem &like);

  double             from() const { return from_; }
  double             to() const { return to_; }
  const std::string &unit() const { return unit_; }
  int                ratio() const { return like_.ratio; } ///< periods of the excitation in the period of a member

  /// The machine at a value, with the periodicity conditions of `like` and the period of its own loads.
  std::shared_ptr<MachineMember> member(double value) const;
  coupling::ProblemFamily        problems() const;

  /// "the period becomes infinite at parameters.n = 0" if the frequency of a load falls to zero between the two values,
  /// so that there is no scene beyond; else empty.
  /// @param within  a value with a valid scene
  std::string standstill(double within, double beyond) const;

private:
  Scene scene_at(double value) const;
  Scene last_scene() const;

  Variant                                       file_;
  std::string                                   key_, unit_;
  PeriodicRequest                               request_;
  double                                        from_ = 0., to_ = 0.;
  std::shared_ptr<const coupling::ReducedFrame> frame_; ///< without pictures; null: the scene reduces none
  coupling::PeriodicProblem                     like_;
};

} // namespace gestell::apps
