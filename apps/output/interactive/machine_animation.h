#pragma once

#include "apps/output/pictures/shape.h"
#include "apps/output/values/result.h"

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace gestell::apps
{

/// Where the points of a part are at some instants: what ideal kinematics gives, and the displacement beside it.
struct PartMotion
{
  Eigen::MatrixXd ideal;        ///< [3 points x instants] m, from where the part rests
  Eigen::MatrixXd displacement; ///< [3 points x instants] m
};

/// Instants that a view shows of a run.
struct AnimationInstants
{
  std::vector<double>          times; ///< [s] ascending
  std::vector<Eigen::VectorXd> states;
};

/// Every k-th picture of the run, so that they are at most `most`, but all of those within three half swings of the
/// main peak, as far as these are no more than half of them; beside them the last one and the main peak stay.
AnimationInstants animation_instants(const Result &result, std::size_t most);

/// Frame and bodies as the view draws them, on few triangles.
class MachineAnimation
{
public:
  explicit MachineAnimation(const Result &result);

  /// The frame, if it has a skin, then the bodies, as they rest: at Result::modes_at, without it at the first picture.
  const std::vector<Shape> &parts() const { return parts_; }
  bool                      has_frame() const { return !chosen_.empty(); }
  /// Points of the whole skin that the frame's are.
  const std::vector<int> &frame_points() const { return chosen_; }
  double                  size() const { return size_; }

  /// One for each part.
  std::vector<PartMotion>      motion(const std::vector<Eigen::VectorXd> &states) const;
  std::vector<Eigen::VectorXd> at_rest() const; ///< zeros [3 points] for each part
  /// Displacement [3 points] of each part in a mode of the frame, or of the machine about its rest.
  std::vector<Eigen::VectorXd> frame_mode(const Eigen::VectorXd &shape) const;
  std::vector<Eigen::VectorXd> machine_mode(const Eigen::VectorXd &shape) const;

private:
  Eigen::MatrixXd    displacements_of_coordinates() const; ///< [3 points x n_frame]
  Eigen::VectorXd    displacement_of(const Eigen::VectorXd &p) const;
  Eigen::VectorXd    frame_displacement(const Eigen::VectorXd &q) const;
  std::vector<Shape> bodies(const Eigen::VectorXd &q) const;

  Scenery            scenery_;
  Eigen::VectorXd    rest_; ///< q
  std::vector<int>   chosen_;
  Eigen::MatrixXd    displacements_; ///< empty: of a frame with many coordinates
  std::vector<Shape> parts_;
  double             size_;
};

} // namespace gestell::apps
