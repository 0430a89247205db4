#include "coupling/integration/step/compliance.h"

#include <algorithm>
#include <cmath>

namespace gestell::coupling
{

LoadedCoordinates::LoadedCoordinates(const Eigen::SparseMatrix<double> &W) : W_(W)
{
  std::vector<int> place(std::size_t(W.rows()), -1);
  for (int j = 0; j < W.outerSize(); ++j)
    for (Eigen::SparseMatrix<double>::InnerIterator it(W, j); it; ++it)
      place[std::size_t(it.row())] = 0;
  for (int i = 0; i < int(place.size()); ++i)
    if (place[std::size_t(i)] == 0)
    {
      place[std::size_t(i)] = int(coordinates_.size());
      coordinates_.push_back(i);
    }
  constexpr double per_index = 6.; // time of a multiplication with an index against one in a vector instruction
  const double     n_u = double(W.cols()), n_N = double(coordinates_.size());
  are_measures_ = n_u * n_u <= n_N * n_N + 2. * per_index * double(W.nonZeros());
  for (int j = 0; j < W.outerSize(); ++j)
  {
    begin_.push_back(int(entries_.size()));
    if (are_measures_)
      entries_.push_back({j, 1.});
    for (Eigen::SparseMatrix<double>::InnerIterator it(W, j); it && !are_measures_; ++it)
      entries_.push_back({place[std::size_t(it.row())], it.value()});
  }
  begin_.push_back(int(entries_.size()));
}

Eigen::VectorXd LoadedCoordinates::unit_force(int i) const
{
  if (are_measures_)
    return W_.col(i);
  return Eigen::VectorXd::Unit(W_.rows(), coordinates_[std::size_t(i)]);
}

Eigen::MatrixXd LoadedCoordinates::rows_of(const Eigen::MatrixXd &Y) const
{
  if (are_measures_)
    return W_.transpose() * Y;
  return Y(coordinates_, Eigen::all);
}

Compliance::Compliance(std::shared_ptr<const LoadedCoordinates> loaded, const Eigen::MatrixXd &Y)
    : loaded_(std::move(loaded)), C_(loaded_->rows_of(Y)), load_(C_.cols()), moved_(C_.cols()),
      terms_(loaded_->n_measures())
{
  for (Eigen::Index j = 0; j < C_.cols(); ++j)
  {
    Range rows{0, int(C_.rows())};
    while (rows.first < rows.last && C_(rows.first, j) == 0.)
      ++rows.first;
    while (rows.last > rows.first && C_(rows.last - 1, j) == 0.)
      --rows.last;
    rows_.push_back(rows);
  }
}

const Eigen::VectorXd &Compliance::loads(const Eigen::VectorXd &p) const
{
  if (loaded_->are_measures())
    return p;
  load_.setZero();
  for (int j = 0; j < int(p.size()); ++j)
    for (const auto &[place, weight] : loaded_->of(j))
      load_[place] += weight * p[j];
  return load_;
}

void Compliance::add_moved(const Eigen::VectorXd &x, Eigen::VectorXd &u) const
{
  for (int j = 0; j < int(u.size()); ++j)
  {
    double sum = 0.;
    for (const auto &[place, weight] : loaded_->of(j))
      sum += weight * x[place];
    u[j] += sum;
  }
}

void Compliance::add_times(const Eigen::VectorXd &p, Eigen::VectorXd &u) const
{
  if (loaded_->are_measures())
  {
    u.noalias() += C_.lazyProduct(p);
    return;
  }
  const Eigen::VectorXd &load = loads(p);
  moved_.setZero();
  for (Eigen::Index j = 0; j < load.size(); ++j)
  {
    const auto [first, last] = rows_[std::size_t(j)];
    moved_.segment(first, last - first) += load[j] * C_.col(j).segment(first, last - first);
  }
  add_moved(moved_, u);
}

double Compliance::own(int measure) const
{
  double sum = 0.;
  for (const auto &[j, w_j] : loaded_->of(measure))
    for (const auto &[i, w_i] : loaded_->of(measure))
      sum += w_i * C_(i, j) * w_j;
  return sum;
}

Compliance::Range Compliance::move(const int *places, int n, const double *f, double *x) const
{
  Range moved{int(C_.rows()), 0};
  std::fill_n(x, C_.rows(), 0.);
  for (int k = 0; k < n; ++k)
  {
    if (f[k] == 0.)
      continue;
    const auto [first, last] = rows_[std::size_t(places[k])];
    const double *column     = C_.data() + C_.rows() * places[k];
    const double  factor     = f[k];
    for (int i = first; i < last; ++i)
      x[i] += factor * column[i];
    moved = {std::min(moved.first, first), std::max(moved.last, last)};
  }
  return moved;
}

const Eigen::VectorXd &Compliance::magnitudes(const Eigen::VectorXd &p) const
{
  load_.setZero();
  for (int j = 0; j < int(p.size()); ++j)
    for (const auto &[place, weight] : loaded_->of(j))
      load_[place] += std::abs(weight * p[j]);
  moved_.noalias() = C_.cwiseAbs().lazyProduct(load_);
  terms_.setZero();
  for (int j = 0; j < int(terms_.size()); ++j)
    for (const auto &[place, weight] : loaded_->of(j))
      terms_[j] += std::abs(weight) * moved_[place];
  return terms_;
}

const Eigen::MatrixXd &Compliance::matrix() const
{
  if (loaded_->are_measures())
    return C_;
  const auto n_u = Eigen::Index(loaded_->n_measures());
  if (S_.cols() == n_u)
    return S_;
  S_.setZero(n_u, n_u);
  Eigen::VectorXd p = Eigen::VectorXd::Zero(n_u), u = p;
  for (Eigen::Index j = 0; j < n_u; ++j)
  {
    p[j] = 1.;
    u.setZero();
    add_times(p, u);
    S_.col(j) = u;
    p[j]      = 0.;
  }
  return S_;
}

} // namespace gestell::coupling
