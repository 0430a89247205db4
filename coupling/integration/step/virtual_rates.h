#pragma once

#include "coupling/integration/system/second_order_system.h"

#include <utility>
#include <vector>

namespace gestell::coupling
{

/**
 * The rates of lag (massless) coordinates x at an instant.  Their rate is not a state but follows from
 *
 *     b x' + c x = p,
 *
 * A multistep method that starts with another rate sees the difference as an error that no smaller step removes.
 */
class VirtualRates
{
public:
  explicit VirtualRates(const SecondOrderSystem &system);

  bool none() const { return rows_.empty(); }

  /// Writes x' into v [n] and local.v, for q [n] and the forces local.p at the same instant.
  void settle(const Eigen::Ref<const Eigen::VectorXd> &q, Eigen::Ref<Eigen::VectorXd> v, LocalState &local) const;

private:
  struct Row
  {
    int                                 coordinate;
    double                              b, c;
    std::vector<std::pair<int, double>> measures; ///< and the weight of the coordinate in them
  };
  std::vector<Row> rows_;
};

} // namespace gestell::coupling
