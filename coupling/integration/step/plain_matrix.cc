#include "coupling/integration/step/plain_matrix.h"

#include <algorithm>

namespace gestell::coupling
{

PlainMatrix::PlainMatrix(const std::vector<ForceBlock> &blocks, int n_u)
    : blocks_(blocks), S_B_(Eigen::MatrixXd::Zero(n_u, n_u)), y_(Eigen::VectorXd::Zero(n_u))
{
  seen_.reserve(std::size_t(n_u));
  J_.resize(n_u);
}

bool PlainMatrix::factorise(const Eigen::MatrixXd &S, const double *tangent, const std::vector<HeldMeasure> &held)
{
  const auto n_u = S.rows();
  seen_.clear();
  double *moved = S_B_.data();
  for (const ForceBlock &block : blocks_)
    for (int j = 0; j < block.n_measures; ++j, tangent += block.n_measures)
    {
      const int measure = block.first_measure + j;
      if (std::any_of(held.begin(), held.end(), [&](const HeldMeasure &h) { return h.measure == measure; }))
      {
        const double  own = S(measure, measure), force = own > 0. ? 1. / own : 1.;
        const double *unit = S.data() + n_u * measure;
        for (Eigen::Index i = 0; i < n_u; ++i)
          moved[i] = force * unit[i];
        seen_.push_back({measure, force});
        moved += n_u;
        continue;
      }
      bool acts = false;
      for (int i = 0; i < block.n_measures; ++i)
      {
        const double p = tangent[i];
        if (p == 0.)
          continue;
        const double *unit = S.data() + n_u * (block.first_measure + i);
        for (Eigen::Index row = 0; row < n_u; ++row)
          moved[row] = acts ? moved[row] + p * unit[row] : p * unit[row];
        acts = true;
      }
      if (!acts)
        continue;
      seen_.push_back({measure, 0.});
      moved += n_u;
    }
  const int n = size();
  double   *J = J_.use(n);
  for (int c = 0; c < n; ++c, J += n)
  {
    const double *column = S_B_.data() + n_u * c;
    for (int a = 0; a < n; ++a)
      J[a] = -column[seen_[std::size_t(a)].measure];
    if (seen_[std::size_t(c)].force == 0.) // of what sticks without E: adding 1 would round a small S away
      J[c] += 1.;
  }
  return J_.factorise(!held.empty());
}

void PlainMatrix::solve_in_place(Eigen::VectorXd &r)
{
  const int n = size();
  for (int a = 0; a < n; ++a)
    y_[a] = r[seen_[std::size_t(a)].measure];
  J_.solve_in_place(y_);
  if (n < int(r.size()))
    for (int a = 0; a < n; ++a)
    {
      const double *column = S_B_.data() + r.size() * a;
      for (Eigen::Index i = 0; i < r.size(); ++i)
        r[i] += column[i] * y_[a];
    }
  for (int a = 0; a < n; ++a)
    r[seen_[std::size_t(a)].measure] = seen_[std::size_t(a)].force == 0. ? y_[a] : seen_[std::size_t(a)].force * y_[a];
}

} // namespace gestell::coupling
