#pragma once

#include "apps/output/pictures/shape.h"
#include "apps/output/values/result.h"

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace gestell::apps
{

/// Positions of the points of a part at some instants: by ideal kinematics, and the displacement from there.
struct PartMotion
{
  Eigen::MatrixXd ideal;        ///< [3 points x instants] m, relative to the rest position
  Eigen::MatrixXd displacement; ///< [3 points x instants] m
};

/// Instants of a run that the view shows.
struct AnimationInstants
{
  std::vector<double>          times; ///< [s] ascending
  std::vector<Eigen::VectorXd> states;
};

/// The chosen_pictures() and, in addition, the main peak.
AnimationInstants animation_instants(const Result &result, std::size_t most);

/// Frame and bodies for the view, on few triangles.
class MachineAnimation
{
public:
  explicit MachineAnimation(const Result &result);

  /// The frame, if it has a skin, then the bodies, in the rest position: at Result::modes_at, or the first saved state.
  const std::vector<Shape> &parts() const { return parts_; }
  bool                      has_frame() const { return !chosen_.empty(); }
  /// Indices of the frame's points in the whole skin.
  const std::vector<int> &frame_points() const { return chosen_; }
  double                  size() const { return size_; }

  /// One for each part.
  std::vector<PartMotion>      motion(const std::vector<Eigen::VectorXd> &states) const;
  std::vector<Eigen::VectorXd> at_rest() const; ///< zeros [3 points] for each part
  /// Displacement [3 points] of each part in a mode of the frame, or of the machine about its rest position.
  std::vector<Eigen::VectorXd> frame_mode(const Eigen::VectorXd &shape) const;
  std::vector<Eigen::VectorXd> machine_mode(const Eigen::VectorXd &shape) const;

private:
  Eigen::MatrixXd    displacements_of_coordinates() const; ///< [3 points x n_frame]
  Eigen::VectorXd    displacement_of(const Eigen::VectorXd &p) const;
  Eigen::MatrixXd    frame_displacements(const Eigen::MatrixXd &p) const; ///< by columns of coordinates [n_frame]
  std::vector<Shape> bodies(const Eigen::VectorXd &q) const;

  Scenery            scenery_;
  Eigen::VectorXd    rest_; ///< q
  std::vector<int>   chosen_;
  Eigen::MatrixXd    displacements_; ///< empty for a frame with many coordinates
  std::vector<Shape> parts_;
  double             size_;
};

} // namespace gestell::apps
