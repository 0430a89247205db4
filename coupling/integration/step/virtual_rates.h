#pragma once

#include "coupling/integration/system/second_order_system.h"

#include <utility>
#include <vector>

namespace gestell::coupling
{

/**
 * The rates of virtual coordinates x at an instant.  Without mass their rate is no state but follows from theirs,
 *
 *     b x' + c x = p,
 *
 * and a multistep method that begins with another one takes the difference for an error that no smaller step removes.
 */
class VirtualRates
{
public:
  explicit VirtualRates(const SecondOrderSystem &system);

  bool none() const { return rows_.empty(); }

  /// Puts x' into v [n] and local.v, for q [n] and the forces local.p at the same instant.
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
