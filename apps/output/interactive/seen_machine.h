#pragma once

#include "apps/output/pictures/skin_picture.h"
#include "apps/output/values/result.h"

#include <Eigen/Core>

#include <vector>

namespace gestell::apps
{

/// Where the points of a part are at some instants: what ideal kinematics gives, and the displacement beside it.
struct PartMotion
{
  Eigen::MatrixXd ideal;        ///< [3 points x instants] m, from the first instant on
  Eigen::MatrixXd displacement; ///< [3 points x instants] m
};

/// Frame and bodies as the view draws them, on few triangles.
class SeenMachine
{
public:
  explicit SeenMachine(const Result &result);

  /// The frame, if it has a skin, then the bodies, as they stand at the start of the run.
  const std::vector<Shape> &parts() const { return parts_; }
  bool                      has_frame() const { return !chosen_.empty(); }
  /// Points of the whole skin that the frame's are.
  const std::vector<int> &frame_points() const { return chosen_; }
  double                  size() const { return size_; }

  /// One for each part.
  std::vector<PartMotion>      motion(const std::vector<Eigen::VectorXd> &states) const;
  std::vector<Eigen::VectorXd> at_rest() const; ///< zeros [3 points] for each part
  /// Displacement [3 points] of each part in a mode of the frame, or of the machine about the start.
  std::vector<Eigen::VectorXd> frame_mode(const Eigen::VectorXd &shape) const;
  std::vector<Eigen::VectorXd> machine_mode(const Eigen::VectorXd &shape) const;

private:
  Eigen::MatrixXd    displacements_of_coordinates() const; ///< [3 points x n_frame]
  Eigen::VectorXd    displacement_of(const Eigen::VectorXd &p) const;
  Eigen::VectorXd    frame_displacement(const Eigen::VectorXd &q) const;
  std::vector<Shape> bodies(const Eigen::VectorXd &q) const;

  Scenery            scenery_;
  Eigen::VectorXd    start_; ///< q
  std::vector<int>   chosen_;
  Eigen::MatrixXd    displacements_; ///< empty: of a frame with many coordinates
  std::vector<Shape> parts_;
  double             size_;
};

} // namespace gestell::apps
