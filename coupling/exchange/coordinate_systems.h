#pragma once

#include "coupling/exchange/text_file.h"

#include <Eigen/Core>

#include <array>
#include <map>
#include <set>
#include <vector>

namespace gestell::coupling
{

/**
 * Rectangular coordinate systems of a Nastran model (CORD2R), by their numbers; 0 is the basic one.
 *
 *     CORD2R, CID, RID, A1, A2, A3, B1, B2, B3, C1, C2, C3
 *
 * A is the origin, B a point of the z-axis, C one of the x-z-plane, all in the system RID.
 *
 * @throws std::invalid_argument with line: points on a line, systems that refer to each other in a circle.
 */
class CoordinateSystems
{
public:
  struct System
  {
    Eigen::Vector3d origin = Eigen::Vector3d::Zero();
    Eigen::Matrix3d axes   = Eigen::Matrix3d::Identity(); ///< x, y, z as columns, in the basic system
  };

  explicit CoordinateSystems(TextFile &file);

  /// Null if there is none, or one that is not rectangular.
  const System *find(long number) const;

private:
  struct Card
  {
    long                           reference, line;
    std::array<Eigen::Vector3d, 3> points;
  };
  /// The system, and those that it refers to.
  void resolve(const TextFile &file, long number);
  void add(const TextFile &file, long number, const Card &card, const System &reference);

  std::map<long, Card>   cards_;
  std::map<long, System> systems_;
  std::set<long>         without_place_; ///< based on one that is not rectangular, or missing
};

} // namespace gestell::coupling
