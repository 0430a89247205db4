#include "coupling/equilibrium/static_expansion.h"

#include "coupling/algebra/sparse_cholesky.h"

namespace gestell::coupling
{

namespace
{
/// Pairs (coordinate of the full frame, coordinate of the reduced one) of all interfaces.
std::vector<std::pair<int, int>> matching_interfaces(const Machine &full, const Machine &reduced)
{
  std::vector<std::pair<int, int>> pairs;
  const auto                      &theirs = reduced.model().reduced_frame()->interfaces;
  for (const fem::Interface &mine : full.model().full_frame()->interfaces)
    for (const fem::Interface &other : theirs)
      if (other.name == mine.name)
        for (int i = 0; i < 6; ++i)
          if (mine.coordinate[i] >= 0)
            pairs.emplace_back(mine.coordinate[i], other.coordinate[i]);
  if (static_cast<int>(pairs.size()) != full.model().n_interface() ||
      full.model().n_interface() != reduced.model().n_interface())
    throw std::invalid_argument("expand_statically: the two frames do not have the same interfaces");
  return pairs;
}
} // namespace

InitialState expand_statically(const Machine &full, const Machine &reduced, const InitialState &state)
{
  InitialState expanded{state.t, Eigen::VectorXd::Zero(full.size()), Eigen::VectorXd::Zero(full.size()), state.settled,
                        state.notes};
  const int    n_frame      = full.model().n_frame();
  const auto  &C            = full.model().full_frame()->C;
  const int    n_bodies     = full.model().n_mechanism();
  expanded.q.tail(n_bodies) = state.q.tail(n_bodies);
  expanded.v.tail(n_bodies) = state.v.tail(n_bodies);

  const bool       relieved = state.acceleration.size() > 0;
  Eigen::VectorXd  rigid    = Eigen::VectorXd::Zero(n_frame); // q''
  std::vector<int> place(n_frame, 0);                         // of an inner coordinate in q2, -1 for q1
  for (const auto &[mine, other] : matching_interfaces(full, reduced))
  {
    expanded.q[mine] = state.q[other];
    expanded.v[mine] = state.v[other];
    place[mine]      = -1;
    if (relieved)
      rigid[mine] = state.acceleration[other];
  }
  int n2 = 0;
  for (int &i : place)
    if (i == 0)
      i = n2++;

  Eigen::VectorXd load(full.size());
  full.linear().excitation().at(state.t, load);
  const Eigen::VectorXd               force    = load.head(n_frame) - C * expanded.q.head(n_frame);
  const Eigen::VectorXd               rate     = -(C * expanded.v.head(n_frame));
  const Eigen::VectorXd               of_rigid = -(C * rigid);
  Eigen::MatrixXd                     inner(n2, relieved ? 3 : 2);
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(C.nonZeros());
  for (int j = 0; j < n_frame; ++j)
  {
    if (place[j] < 0)
      continue;
    inner.row(place[j]).head<2>() << force[j], rate[j];
    if (relieved)
      inner(place[j], 2) = of_rigid[j];
    for (Eigen::SparseMatrix<double>::InnerIterator it(C, j); it; ++it)
      if (place[it.row()] >= 0)
        entries.emplace_back(place[it.row()], place[j], it.value());
  }
  Eigen::SparseMatrix<double> C22(n2, n2);
  C22.setFromTriplets(entries.begin(), entries.end());
  const SparseCholesky factor(C22);
  factor.solve_in_place(inner);
  if (relieved)
  {
    for (int i = 0; i < n_frame; ++i)
      if (place[i] >= 0)
        rigid[i] = inner(place[i], 2);
    const Eigen::VectorXd inertia = -(full.model().full_frame()->M * rigid);
    for (int i = 0; i < n_frame; ++i)
      if (place[i] >= 0)
        inner(place[i], 2) = inertia[i];
    Eigen::MatrixXd deflection = inner.rightCols<1>();
    factor.solve_in_place(deflection);
    inner.col(0) += deflection;
  }
  for (int i = 0; i < n_frame; ++i)
    if (place[i] >= 0)
    {
      expanded.q[i] = inner(place[i], 0);
      expanded.v[i] = inner(place[i], 1);
    }
  return expanded;
}

} // namespace gestell::coupling
