#include "coupling/integration/step/condensed_matrix.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gestell::coupling
{

bool CondensedMatrix::Block::meets(const Compliance::Range &moved) const
{
  return !places.empty() && places.front() < moved.last && places.back() >= moved.first;
}

/// A row or column on the measures, on the places.
void CondensedMatrix::Block::to_places(const double *on_measures, double *on_places) const
{
  std::fill_n(on_places, places.size(), 0.);
  for (int j = 0; j < n_measures; ++j)
    if (on_measures[j] != 0.)
      for (int e = begin[std::size_t(j)]; e < begin[std::size_t(j) + 1]; ++e)
        on_places[entries[std::size_t(e)].place] += entries[std::size_t(e)].weight * on_measures[j];
}

void CondensedMatrix::Block::gather(const double *x, double *own) const
{
  for (std::size_t i = 0; i < places.size(); ++i)
    own[i] = x[places[i]];
}

namespace
{
constexpr int few = 3; ///< measures of an element that are used as they are

double product(const double *a, const double *b, int n)
{
  using Numbers = Eigen::Map<const Eigen::VectorXd>;
  return Numbers(a, n).dot(Numbers(b, n));
}

/// Displacement of a sticking measure under a unit force, which converts its unknown to a displacement like all others.
double own_compliance(const Compliance &S, int measure)
{
  const double own = S.own(measure);
  return own > 0. ? own : 1.;
}
} // namespace

CondensedMatrix::CondensedMatrix(const SecondOrderSystem &system, const LoadedCoordinates &loaded)
{
  add_blocks(system, loaded);
  std::size_t n_F = 0, largest = 0, most = 0;
  for (const Block &block : force_blocks_)
  {
    n_F += std::size_t(block.n_measures);
    largest = std::max(largest, std::size_t(block.n_measures));
    most    = std::max(most, block.places.size());
  }
  for (const Block &block : joint_blocks_)
    most = std::max(most, block.places.size());
  const auto n_u = system.forces().directions().cols();
  if (loaded.are_measures() && equations_.empty() && largest <= std::size_t(few))
    plain_ = std::make_unique<PlainMatrix>(system.forces().blocks(), int(n_u));
  const auto n_c = equations_.size();
  scalars_.reserve(n_F);
  kept_held_.reserve(n_F);
  kept_tangent_.setZero(Eigen::Index(l_.size()));
  rest_.resize(largest * largest);
  size_.resize(largest * largest);
  own_.resize(most);
  moved_.setZero(loaded.size());
  forces_.resize(int(n_F));
  joints_.resize(int(n_c));
  S_G_.setZero(loaded.size(), Eigen::Index(n_c));
  S_G_rows_.assign(n_c, {0, 0});
  G_S_G_.setZero(Eigen::Index(n_c), Eigen::Index(n_c));
  X_.resize(n_F * n_c);
  P_.resize(n_F * n_c);
  y_.setZero(Eigen::Index(n_F));
  p_.setZero(n_u);
}

/// The blocks with their numbers, which stay where they are.
void CondensedMatrix::add_blocks(const SecondOrderSystem &system, const LoadedCoordinates &loaded)
{
  std::size_t on_measures = 0, on_places = 0;
  for (const ForceBlock &element : system.forces().blocks())
  {
    Block block       = block_of(loaded, element.first_measure, element.n_measures);
    block.on_measures = on_measures;
    block.on_places   = on_places;
    on_measures += std::size_t(block.n_measures) * std::size_t(block.n_measures);
    on_places += std::size_t(block.n_measures) * block.places.size();
    force_blocks_.push_back(std::move(block));
  }
  for (auto *numbers : {&l_, &b_})
    numbers->resize(on_measures);
  for (auto *numbers : {&l_q_, &b_q_})
    numbers->resize(on_places);
  on_places = 0;
  for (const ConstraintBlock &joint : system.joints().blocks())
  {
    joint_blocks_.push_back(block_of(loaded, joint.first_measure, joint.n_measures));
    joint_blocks_.back().on_places = on_places;
    on_places += std::size_t(joint.n_rows) * joint_blocks_.back().places.size();
  }
  G_q_.resize(on_places);
  for (std::size_t i = 0; i < joint_blocks_.size(); ++i)
    for (int r = 0; r < system.joints().blocks()[i].n_rows; ++r)
    {
      const Block &block = joint_blocks_[i];
      double      *row   = G_q_.data() + block.on_places + std::size_t(r) * block.places.size();
      equations_.push_back({&block, -1, false, nullptr, nullptr, row, row});
    }
}

CondensedMatrix::Block CondensedMatrix::block_of(const LoadedCoordinates &loaded, int first_measure, int n_measures)
{
  Block block;
  block.first_measure = first_measure;
  block.n_measures    = n_measures;
  for (int j = 0; j < n_measures; ++j)
    for (const auto &entry : loaded.of(first_measure + j))
      block.places.push_back(entry.place);
  std::sort(block.places.begin(), block.places.end());
  block.places.erase(std::unique(block.places.begin(), block.places.end()), block.places.end());
  for (int j = 0; j < n_measures; ++j)
  {
    block.begin.push_back(int(block.entries.size()));
    for (const auto &[place, weight] : loaded.of(first_measure + j))
      block.entries.push_back(
          {int(std::lower_bound(block.places.begin(), block.places.end(), place) - block.places.begin()), weight});
  }
  block.begin.push_back(int(block.entries.size()));
  return block;
}

void CondensedMatrix::set_joints(const Compliance &S, const ConstraintJacobian &G)
{
  joints_known_        = false;
  std::size_t equation = 0;
  for (std::size_t i = 0; i < joint_blocks_.size(); ++i)
  {
    const Block  &block  = joint_blocks_[i];
    const auto    own    = G[i];
    const auto    n_rows = int(own.rows());
    const double *value  = own.data();
    double       *rows   = equations_[equation].l_q;
    const int     m      = block.n_places();
    std::fill_n(rows, n_rows * m, 0.);
    for (int j = 0; j < block.n_measures; ++j, value += n_rows)
      for (int e = block.begin[std::size_t(j)]; e < block.begin[std::size_t(j) + 1]; ++e)
        for (int r = 0; r < n_rows; ++r)
          rows[m * r + block.entries[std::size_t(e)].place] += block.entries[std::size_t(e)].weight * value[r];
    equation += std::size_t(n_rows);
  }
  for (std::size_t c = 0; c < equations_.size(); ++c)
  {
    const Scalar &column = equations_[c];
    double       *moved  = S_G_.data() + S_G_.rows() * Eigen::Index(c);
    double       *upper  = G_S_G_.data() + G_S_G_.rows() * Eigen::Index(c);
    S_G_rows_[c]         = S.move(column.block->places.data(), column.block->n_places(), column.l_q, moved);
    multiply(equations_.data(), int(c) + 1, moved, S_G_rows_[c], upper, nullptr);
    for (std::size_t d = 0; d < c; ++d)
      G_S_G_(Eigen::Index(c), Eigen::Index(d)) = upper[d];
  }
}

/// L x and B^T x of consecutive scalars, for x on the places `moved`.
void CondensedMatrix::multiply(const Scalar *rows, int n, const double *x, const Compliance::Range &moved, double *L_x,
                               double *B_x)
{
  const Block *seen  = nullptr;
  bool         meets = false;
  for (int a = 0; a < n; ++a)
  {
    if (rows[a].block != seen)
    {
      seen  = rows[a].block;
      meets = seen->meets(moved);
      if (meets)
        seen->gather(x, own_.data());
    }
    L_x[a] = meets ? product(rows[a].l_q, own_.data(), seen->n_places()) : 0.;
    if (B_x)
      B_x[a] = meets ? product(rows[a].b_q, own_.data(), seen->n_places()) : 0.;
  }
}

CondensedMatrix::Scalar &CondensedMatrix::add_scalar(const Block &block, int measure, bool held)
{
  const std::size_t of_block =
      scalars_.empty() || scalars_.back().block != &block
          ? 0
          : std::size_t(scalars_.back().l - (l_.data() + block.on_measures)) / std::size_t(block.n_measures) + 1;
  const std::size_t on_measures = block.on_measures + of_block * std::size_t(block.n_measures),
                    on_places   = block.on_places + of_block * block.places.size();
  scalars_.push_back({&block, measure, held, l_.data() + on_measures, b_.data() + on_measures, l_q_.data() + on_places,
                      b_q_.data() + on_places});
  return scalars_.back();
}

/// Divides p' of an element by complete pivoting, p' = sum b l; a remainder within the rounding of its terms is zero.
/// @return false: there are as many scalars as measures, and nothing is gained
bool CondensedMatrix::collect_combinations(const Block &block, const double *tangent)
{
  // an entry is a product of a law's derivative and two of the geometry, twice: by the element and here
  constexpr double rounding = 16. * std::numeric_limits<double>::epsilon();
  const int        k        = block.n_measures;
  const auto       before   = scalars_.size();
  using Numbers             = Eigen::Map<Eigen::ArrayXd>;
  Numbers all(rest_.data(), k * k), sizes(size_.data(), k * k);
  all   = Eigen::Map<const Eigen::ArrayXd>(tangent, k * k);
  sizes = all.abs();
  for (int rank = 0;; ++rank)
  {
    const double largest = all.abs().maxCoeff();
    if (largest == 0.)
      break;
    if (2 * (rank + 1) > k || !std::isfinite(largest))
    {
      scalars_.erase(scalars_.begin() + std::ptrdiff_t(before), scalars_.end());
      return false;
    }
    int pivot = 0;
    while (std::abs(all[pivot]) != largest)
      ++pivot;
    const int row = pivot % k, column = pivot / k;
    Scalar   &scalar = add_scalar(block, -1, false);
    for (int j = 0; j < k; ++j)
    {
      scalar.b[j] = rest_[std::size_t(j + k * column)];
      scalar.l[j] = rest_[std::size_t(row + k * j)] / rest_[std::size_t(pivot)];
    }
    for (int j = 0; j < k; ++j)
    {
      const double l = scalar.l[j];
      if (l == 0.)
        continue;
      double *rest = rest_.data() + k * j, *size = size_.data() + k * j;
      for (int i = 0; i < k; ++i)
      {
        const double term = scalar.b[i] * l, left = rest[i] - term;
        size[i] += std::abs(term);
        rest[i] = std::abs(left) <= rounding * size[i] ? 0. : left;
      }
    }
    block.to_places(scalar.l, scalar.l_q);
    block.to_places(scalar.b, scalar.b_q);
  }
  return true;
}

/// Every measure on which the force depends, or that sticks, is a scalar.
void CondensedMatrix::collect_measures(const Compliance &S, const Block &block, const double *tangent,
                                       const std::vector<HeldMeasure> &held)
{
  const int k = block.n_measures;
  for (int j = 0; j < k; ++j)
  {
    const int     measure = block.first_measure + j;
    const double *column  = tangent + k * j;
    const bool    sticks =
        std::any_of(held.begin(), held.end(), [&](const HeldMeasure &h) { return h.measure == measure; });
    if (!sticks && std::all_of(column, column + k, [](double p) { return p == 0.; }))
    {
      all_seen_ = false;
      continue;
    }
    Scalar &scalar = add_scalar(block, measure, sticks);
    std::fill_n(scalar.l, k, 0.);
    scalar.l[j] = 1.;
    std::copy_n(column, k, scalar.b);
    if (sticks)
      scalar.b[j] = 1. / own_compliance(S, measure);
    block.to_places(scalar.l, scalar.l_q);
    block.to_places(scalar.b, scalar.b_q);
  }
}

void CondensedMatrix::collect(const Compliance &S, const double *tangent, const std::vector<HeldMeasure> &held)
{
  scalars_.clear();
  all_seen_ = true;
  for (const Block &block : force_blocks_)
  {
    const bool sticks =
        std::any_of(held.begin(), held.end(),
                    [&](const HeldMeasure &h)
                    { return h.measure >= block.first_measure && h.measure < block.first_measure + block.n_measures; });
    if (block.n_measures > few && !sticks && collect_combinations(block, tangent))
      all_seen_ = false;
    else
      collect_measures(S, block, tangent, held);
    tangent += block.n_measures * block.n_measures;
  }
}

/// J = E - L S B; for what sticks without E: adding 1 and taking it away again would round a small S away.
void CondensedMatrix::fill_forces(const Compliance &S)
{
  const int n = n_scalars();
  double   *J = forces_.use(n);
  for (int c = 0; c < n; ++c, J += n)
  {
    const Scalar &column = scalars_[std::size_t(c)];
    const auto    moved  = S.move(column.block->places.data(), column.block->n_places(), column.b_q, moved_.data());
    multiply(scalars_.data(), n, moved_.data(), moved, J, nullptr);
    for (int a = 0; a < n; ++a)
      J[a] = -J[a];
    if (!column.held)
      J[c] += 1.;
  }
}

/// P_L, P_B, J^-1 P_L and H.
void CondensedMatrix::border()
{
  const int n = n_scalars(), n_c = int(equations_.size());
  for (int c = 0; c < n_c; ++c)
  {
    double *x = X_.data() + n * c;
    multiply(scalars_.data(), n, S_G_.data() + S_G_.rows() * c, S_G_rows_[std::size_t(c)], x, P_.data() + n * c);
    forces_.solve_in_place(x);
  }
  Eigen::MatrixXd &H = joints_.matrix();
  for (int c = 0; c < n_c; ++c)
    for (int d = 0; d < n_c; ++d)
      H(d, c) = G_S_G_(d, c) + product(P_.data() + n * d, X_.data() + n * c, n);
}

/// Elements whose p' does not change are as frequent as those whose forces do not act.
bool CondensedMatrix::keeps_forces(const Compliance &S, const Eigen::VectorXd &tangent,
                                   const std::vector<HeldMeasure> &held) const
{
  const auto same = [](int measure, const HeldMeasure &h) { return measure == h.measure; };
  return kept_S_ == &S && std::equal(kept_held_.begin(), kept_held_.end(), held.begin(), held.end(), same) &&
         tangent == kept_tangent_;
}

bool CondensedMatrix::factorise_forces(const Compliance &S, const Eigen::VectorXd &tangent,
                                       const std::vector<HeldMeasure> &held)
{
  kept_S_ = nullptr;
  if (plain_)
  {
    if (!plain_->factorise(S.matrix(), tangent.data(), held))
      return false;
  }
  else
  {
    collect(S, tangent.data(), held);
    fill_forces(S);
    if (!forces_.factorise(!held.empty()))
      return false;
  }
  kept_S_       = &S;
  kept_tangent_ = tangent;
  kept_held_.clear();
  for (const HeldMeasure &h : held)
    kept_held_.push_back(h.measure);
  return true;
}

bool CondensedMatrix::factorise(const Compliance &S, const Eigen::VectorXd &tangent,
                                const std::vector<HeldMeasure> &held)
{
  failed_joint_ = -1;
  if (!keeps_forces(S, tangent, held))
  {
    joints_known_ = false;
    if (!factorise_forces(S, tangent, held))
      return false;
  }
  if (joints_known_ || equations_.empty())
    return true;
  border();
  joints_known_ = joints_.factorise();
  failed_joint_ = joints_known_ ? -1 : joints_.failed();
  return joints_known_;
}

void CondensedMatrix::solve_in_place(const Compliance &S, const ConstraintJacobian &G, Eigen::VectorXd &r,
                                     Eigen::VectorXd &g)
{
  if (plain_)
  {
    plain_->solve_in_place(r);
    return;
  }
  const int n = n_scalars(), n_c = int(equations_.size());
  for (int a = 0; a < n; ++a)
  {
    const Scalar &row = scalars_[std::size_t(a)];
    const double *own = r.data() + row.block->first_measure;
    y_[a]             = row.measure >= 0 ? r[row.measure] : product(row.l, own, row.block->n_measures);
  }
  forces_.solve_in_place(y_);
  if (n_c > 0)
  {
    G.add_product(1., r, g);
    for (int c = 0; c < n_c; ++c)
      g[c] = -g[c] - product(P_.data() + n * c, y_.data(), n);
    joints_.solve_in_place(g);
    for (int c = 0; c < n_c; ++c)
      for (int a = 0; a < n; ++a)
        y_[a] += X_[std::size_t(n * c + a)] * g[c];
  }
  if (n_c > 0 || !all_seen_)
    add_motion(S, G, g, r);
  for (int a = 0; a < n; ++a)
    if (const Scalar &row = scalars_[std::size_t(a)]; row.measure >= 0)
      r[row.measure] = row.held ? y_[a] * row.b[row.measure - row.block->first_measure] : y_[a];
}

/// r += S (B y + G^T dlambda)
void CondensedMatrix::add_motion(const Compliance &S, const ConstraintJacobian &G, const Eigen::VectorXd &dlambda,
                                 Eigen::VectorXd &r)
{
  p_.setZero();
  for (int a = 0; a < n_scalars(); ++a)
  {
    const Scalar &column = scalars_[std::size_t(a)];
    double       *p      = p_.data() + column.block->first_measure;
    for (int j = 0; j < column.block->n_measures; ++j)
      p[j] += column.b[j] * y_[a];
  }
  if (!equations_.empty())
    G.set_forces(dlambda, p_);
  S.add_times(p_, r);
}

} // namespace gestell::coupling
