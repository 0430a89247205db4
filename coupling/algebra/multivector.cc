#include "coupling/algebra/multivector.h"

#include "coupling/algebra/triangular_solve_kernels.h"

#include <algorithm>
#include <cassert>
#include <cstddef>

namespace gestell::coupling
{

namespace
{

using Eigen::MatrixXd;
using std::ptrdiff_t;

constexpr int strip = 64; // tiles that stay in the cache while all columns are gone through

int panels_for(int columns, int lanes)
{
  return (columns + lanes - 1) / lanes;
}

/// Copies the columns of A from `panel * lanes` on, row by row, padded with zeros.
std::vector<double> by_rows(const MatrixXd &A, int panel, int lanes)
{
  const int           first = panel * lanes, columns = std::min<int>(lanes, int(A.cols()) - first);
  std::vector<double> rows(A.rows() * lanes, 0.);
  for (Eigen::Index i = 0; i < A.rows(); ++i)
    for (int j = 0; j < columns; ++j)
      rows[i * lanes + j] = A(i, first + j);
  return rows;
}

template <typename Visit>
void for_each_strip(int n_tiles, const Visit &visit)
{
  for (int first = 0; first < n_tiles; first += strip)
    visit(first, std::min(strip, n_tiles - first));
}

} // namespace

MultiVector::MultiVector(int n, int columns) : n_(n), columns_(columns), algebra_(&block_algebra(columns))
{
  for (int p = 0; p < panels_for(columns, lanes()); ++p)
    panels_.emplace_back(n_tiles() * tile_step());
}

double &MultiVector::operator()(int i, int j)
{
  return panels_[j / lanes()].data()[ptrdiff_t(i) * lanes() + j % lanes()];
}

void MultiVector::take(const Eigen::Ref<const MatrixXd> &Y, const std::vector<int> &order)
{
  assert(Y.rows() == n_ && Y.cols() == columns_);
  for (int k = 0; k < n_; ++k)
    for (int j = 0; j < columns_; ++j)
      (*this)(k, j) = Y(order[k], j);
}

void MultiVector::give(Eigen::Ref<MatrixXd> Y, const std::vector<int> &order) const
{
  assert(Y.rows() == n_ && Y.cols() == columns_);
  for (int k = 0; k < n_; ++k)
    for (int j = 0; j < columns_; ++j)
      Y(order[k], j) = (*this)(k, j);
}

void MultiVector::transform(const MatrixXd &F)
{
  assert(F.rows() == columns_ && F.cols() <= columns_);
  std::vector<std::vector<double>> minus_F; // by panels of the result
  MatrixXd                         padded = MatrixXd::Zero(n_panels() * lanes(), F.cols());
  padded.topRows(F.rows())                = -F;
  for (int q = 0; q < panels_for(int(F.cols()), lanes()); ++q)
    minus_F.push_back(by_rows(padded, q, lanes()));
  const auto          step = tile_step();
  std::vector<double> before(n_panels() * strip * step);
  for_each_strip(n_tiles(),
                 [&](int first, int count)
                 {
                   for (int p = 0; p < n_panels(); ++p)
                   {
                     double *const x = panels_[p].data() + first * step;
                     std::copy_n(x, count * step, before.data() + p * strip * step);
                     std::fill_n(x, count * step, 0.);
                   }
                   for (std::size_t q = 0; q < minus_F.size(); ++q)
                     for (int p = 0; p < n_panels(); ++p)
                       algebra_->subtract_transform(count, before.data() + p * strip * step,
                                                    minus_F[q].data() + ptrdiff_t(p) * lanes() * lanes(),
                                                    panels_[q].data() + first * step);
                 });
  columns_ = int(F.cols());
  panels_.resize(minus_F.size());
}

MatrixXd gram(const MultiVector &X, const MultiVector &Y)
{
  assert(X.rows() == Y.rows() && X.lanes() == Y.lanes());
  const int           lanes = X.lanes();
  MatrixXd            G(X.columns(), Y.columns());
  std::vector<double> minus(lanes * lanes);
  for (int p = 0; p < X.n_panels(); ++p)
    for (int q = 0; q < Y.n_panels(); ++q)
    {
      std::fill(minus.begin(), minus.end(), 0.);
      X.algebra().subtract_gram(X.n_tiles(), X.panel(p), Y.panel(q), minus.data());
      for (int i = p * lanes; i < std::min(X.columns(), (p + 1) * lanes); ++i)
        for (int j = q * lanes; j < std::min(Y.columns(), (q + 1) * lanes); ++j)
          G(i, j) = -minus[(i - p * lanes) * lanes + j - q * lanes];
    }
  return G;
}

namespace
{

struct Entry
{
  int    column;
  double value;
};

/// Whether `other` has the entries of `row`, moved by `shift` columns.
bool alike(const std::vector<Entry> &row, const std::vector<Entry> &other, int shift)
{
  return std::equal(row.begin(), row.end(), other.begin(), other.end(),
                    [&](const Entry &a, const Entry &b) { return b.column == a.column + shift && b.value == a.value; });
}

} // namespace

ReorderedMatrix::ReorderedMatrix(const Eigen::SparseMatrix<double> &A, const std::vector<int> &order,
                                 const std::vector<int> &held)
    : n_(int(A.rows())), begin_(1, 0)
{
  assert(A.isCompressed() && int(order.size()) == n_);
  std::vector<int> place(n_);
  for (int k = 0; k < n_; ++k)
    place[order[k]] = k;
  for (const int i : held)
    place[i] = -1;
  const auto row = [&](int k)
  {
    std::vector<Entry> entries;
    if (k < n_ && place[order[k]] >= 0)
      for (Eigen::SparseMatrix<double>::InnerIterator a(A, order[k]); a; ++a)
        if (place[a.row()] >= 0)
          entries.push_back({place[a.row()], a.value()});
    return entries;
  };
  column_.reserve(A.nonZeros()); // most of it is not used
  value_.reserve(A.nonZeros());
  std::vector<Entry> x = row(0), y = row(1), z = row(2);
  for (int k = 0; k < n_;)
  {
    const int rows = k + 2 < n_ && alike(x, y, 1) && alike(x, z, 2) ? 3 : 1;
    first_.push_back(k);
    for (const auto &[column, value] : x)
    {
      column_.push_back(column);
      value_.push_back(value);
    }
    begin_.push_back(int(column_.size()));
    k += rows;
    x = rows == 3 ? row(k) : std::move(y);
    y = rows == 3 ? row(k + 1) : std::move(z);
    z = row(k + 2);
  }
  first_.push_back(n_);
}

void ReorderedMatrix::multiply(const MultiVector &X, MultiVector &Y) const
{
  assert(X.rows() == n_ && Y.rows() == n_ && Y.columns() == X.columns() && Y.lanes() == X.lanes());
  const SparseRows rows{int(first_.size()) - 1, first_.data(), begin_.data(), column_.data(), value_.data()};
  for (int p = 0; p < X.n_panels(); ++p)
    X.algebra().sparse_product(rows, X.panel(p), Y.panel(p));
}

void KrylovBasis::append(const MultiVector &X)
{
  const int  width = X.columns();
  Part       part{LargeArray(ptrdiff_t(n_tiles()) * tile_rows * width), width, width};
  double    *to = part.tiles.data();
  const auto c  = X.lanes();
  for (int t = 0; t < n_tiles(); ++t)
    for (int j = 0; j < width; ++j, to += tile_rows)
    {
      const double *from = X.panel(j / c) + t * X.tile_step() + j % c;
      for (int i = 0; i < tile_rows; ++i)
        to[i] = from[i * c];
    }
  columns_ += width;
  parts_.push_back(std::move(part));
}

MatrixXd KrylovBasis::project(const MultiVector &X, int from) const
{
  const int         lanes = X.lanes();
  MatrixXd          H(columns_ - from, X.columns());
  const std::size_t first_part = part_at(from);
  int               height     = 0;
  for (std::size_t a = first_part; a < parts_.size(); ++a)
    height += parts_[a].width;
  std::vector<double> minus_H(height * lanes);
  for (int q = 0; q < X.n_panels(); ++q)
  {
    std::fill(minus_H.begin(), minus_H.end(), 0.);
    for_each_strip(n_tiles(),
                   [&](int first, int count)
                   {
                     double *h = minus_H.data();
                     for (std::size_t a = first_part; a < parts_.size(); ++a)
                     {
                       const Part &part = parts_[a];
                       X.algebra().subtract_projection(part.tiles.data() + ptrdiff_t(first) * tile_rows * part.width,
                                                       part.width, count, X.panel(q) + first * X.tile_step(), h);
                       h += part.width * lanes;
                     }
                   });
    int           row = 0;
    const double *h   = minus_H.data();
    for (std::size_t a = first_part; a < parts_.size(); h += parts_[a].width * lanes, ++a)
      for (int k = 0; k < parts_[a].used; ++k, ++row)
        for (int j = q * lanes; j < std::min(X.columns(), (q + 1) * lanes); ++j)
          H(row, j) = -h[k * lanes + j - q * lanes];
  }
  return H;
}

MatrixXd KrylovBasis::rows_of_parts(const MatrixXd &H, std::size_t first_part) const
{
  int height = 0;
  for (std::size_t a = first_part; a < parts_.size(); ++a)
    height += parts_[a].width;
  MatrixXd padded = MatrixXd::Zero(height, H.cols());
  int      row = 0, to = 0;
  for (std::size_t a = first_part; a < parts_.size(); ++a)
  {
    padded.middleRows(to, parts_[a].used) = H.middleRows(row, parts_[a].used);
    row += parts_[a].used;
    to += parts_[a].width;
  }
  return padded;
}

void KrylovBasis::subtract_strip(const BlockAlgebra &algebra, std::size_t first_part, int first, int count,
                                 const double *H, double *X) const
{
  for (std::size_t a = first_part; a < parts_.size(); ++a)
  {
    const Part &part = parts_[a];
    algebra.subtract_product(part.tiles.data() + ptrdiff_t(first) * tile_rows * part.width, part.width, count, H, X);
    H += part.width * algebra.columns;
  }
}

void KrylovBasis::subtract(MultiVector &X, const MatrixXd &H, int from) const
{
  const std::size_t first_part = part_at(from);
  const MatrixXd    padded     = rows_of_parts(H, first_part);
  for (int q = 0; q < X.n_panels(); ++q)
  {
    const auto h = by_rows(padded, q, X.lanes());
    for_each_strip(
        n_tiles(), [&](int first, int count)
        { subtract_strip(X.algebra(), first_part, first, count, h.data(), X.panel(q) + first * X.tile_step()); });
  }
}

template <typename Visit>
void KrylovBasis::for_each_product(const MatrixXd &S, const Visit &visit) const
{
  const BlockAlgebra              &algebra   = block_algebra(int(S.cols()));
  const int                        lanes     = algebra.columns;
  const ptrdiff_t                  tile_step = ptrdiff_t(tile_rows) * lanes;
  const MatrixXd                   minus_S   = rows_of_parts(-S, 0);
  std::vector<std::vector<double>> s;
  for (int q = 0; q < panels_for(int(S.cols()), lanes); ++q)
    s.push_back(by_rows(minus_S, q, lanes));
  std::vector<double> rows(s.size() * strip * tile_step);
  const auto          at = [&](int i, int j) -> double &
  { return rows[(j / lanes) * strip * tile_step + ptrdiff_t(i) * lanes + j % lanes]; };
  for_each_strip(n_tiles(),
                 [&](int first, int count)
                 {
                   std::fill(rows.begin(), rows.end(), 0.);
                   for (std::size_t q = 0; q < s.size(); ++q)
                     subtract_strip(algebra, 0, first, count, s[q].data(), rows.data() + q * strip * tile_step);
                   visit(first, count, at);
                 });
}

void KrylovBasis::transform(const MatrixXd &S)
{
  assert(S.rows() == columns_ && S.cols() <= columns_);
  const int kept = int(S.cols());
  for_each_product(S,
                   [&](int first, int count, const auto &row)
                   {
                     int column = 0;
                     for (Part &part : parts_)
                     {
                       double *to = part.tiles.data() + ptrdiff_t(first) * tile_rows * part.width;
                       for (int t = 0; t < count; ++t)
                         for (int j = 0; j < part.width; ++j, to += tile_rows)
                           for (int i = 0; i < tile_rows; ++i)
                             to[i] = column + j < kept ? row(t * tile_rows + i, column + j) : 0.;
                       column += part.width;
                     }
                   });
  int column = 0;
  for (Part &part : parts_)
  {
    part.used = std::clamp(kept - column, 0, part.width);
    column += part.width;
  }
  while (!parts_.empty() && parts_.back().used == 0)
    parts_.pop_back();
  columns_ = kept;
}

void KrylovBasis::give(const MatrixXd &S, const std::vector<int> &order, MatrixXd &V) const
{
  V.resize(n_, S.cols());
  for_each_product(S,
                   [&](int first, int count, const auto &row)
                   {
                     const int rows = std::min(n_ - first * tile_rows, count * tile_rows);
                     for (int j = 0; j < S.cols(); ++j)
                       for (int i = 0; i < rows; ++i)
                         V(order[first * tile_rows + i], j) = row(i, j);
                   });
}

std::size_t KrylovBasis::part_at(int column) const
{
  std::size_t part = 0;
  for (int before = 0; before < column; ++part)
    before += parts_[part].used;
  return part;
}

} // namespace gestell::coupling
