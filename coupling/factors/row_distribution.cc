#include "coupling/factors/row_distribution.h"

#include "coupling/algebra/node_ordering.h"
#include "coupling/eigensolvers/exact_product.h"

#include <petscsf.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <unistd.h>
#include <utility>

namespace gestell::coupling
{

namespace
{

using Eigen::MatrixXd;
using SparseMatrix = Eigen::SparseMatrix<double>;

constexpr int rows_at_once = 1 << 14; ///< of which there is a copy

template <typename T>
bool write(const std::vector<T> &values, std::FILE *file)
{
  const std::size_t size = values.size();
  return std::fwrite(&size, sizeof size, 1, file) == 1 && std::fwrite(values.data(), sizeof(T), size, file) == size;
}

/// Appends to the values.
template <typename T>
void read(std::vector<T> &values, std::FILE *file)
{
  const std::size_t before = values.size();
  std::size_t       size   = 0;
  bool              good   = std::fread(&size, sizeof size, 1, file) == 1;
  values.resize(before + (good ? size : 0));
  good = good && std::fread(values.data() + before, sizeof(T), size, file) == size;
  if (!good)
    throw std::runtime_error("a temporary file with rows of the stiffness cannot be read");
}

/// The free coordinates in the order of nested dissection.
std::vector<int> order_of_free(const SparseMatrix &A, const std::vector<int> &held)
{
  std::vector<char> marks(A.rows(), 0);
  for (const int i : held)
    marks[i] = 1;
  std::vector<int> order = node_ordering(A, held.empty() ? std::vector<char>() : marks);
  order.erase(std::remove_if(order.begin(), order.end(), [&](int i) { return marks[i] != 0; }), order.end());
  return order;
}

/// Rows [first, end) of A in another order; `place` is the row of a coordinate, or -1.
SparseRowBlock rows_in_order(const SparseMatrix &A, const std::vector<int> &order, const std::vector<int> &place,
                             int first, int end)
{
  SparseRowBlock block;
  std::size_t    entries = 0;
  for (int k = first; k < end; ++k)
    entries += A.outerIndexPtr()[order[k] + 1] - A.outerIndexPtr()[order[k]];
  block.column.reserve(entries);
  block.value.reserve(entries);
  std::vector<std::pair<int, double>> row;
  for (int k = first; k < end; ++k)
  {
    row.clear();
    for (SparseMatrix::InnerIterator a(A, order[k]); a; ++a) // column = row, as A is symmetric
      if (place[a.row()] >= 0)
        row.emplace_back(place[a.row()], a.value());
    std::sort(row.begin(), row.end());
    for (const auto &[column, value] : row)
      block.column.push_back(column), block.value.push_back(value);
    block.begin.push_back(int(block.column.size()));
  }
  return block;
}

/// `count` rows of this rank.
SparseRowBlock own_rows(Mat A, int first, int count)
{
  SparseRowBlock block;
  for (int i = first; i < first + count; ++i)
  {
    PetscInt           entries = 0;
    const PetscInt    *columns = nullptr;
    const PetscScalar *values  = nullptr;
    require_petsc(MatGetRow(A, i, &entries, &columns, &values), "own rows");
    block.column.insert(block.column.end(), columns, columns + entries);
    block.value.insert(block.value.end(), values, values + entries);
    block.begin.push_back(int(block.column.size()));
    MatRestoreRow(A, i, &entries, &columns, &values);
  }
  return block;
}

} // namespace

RowDistribution::RowDistribution(const fem::Ranks &ranks, const SparseMatrix *A, const std::vector<int> &held)
    : ranks_(ranks), n_(A ? int(A->rows()) : 0), begin_(ranks.size() + 1, 0)
{
  ranks.agree(
      [&]
      {
        if (ranks.first())
          order_ = order_of_free(*A, held);
      });
  std::ptrdiff_t free = std::ptrdiff_t(order_.size());
  ranks_.broadcast(free);
  ranks_.broadcast(n_);
  constexpr double share_of_first = 0.5; // of the rows of another rank: it stores the mesh and all shapes, too
  const double     own            = double(free) / (share_of_first + ranks.size() - 1);
  for (int rank = 1; rank <= ranks.size(); ++rank)
    begin_[rank] = rank < ranks.size() ? int(own * (share_of_first + rank - 1)) : int(free);
}

PetscOwned<Mat> RowDistribution::distributed(const SparseMatrix *A) const
{
  SparseRowBlock own;
  if (ranks_.first())
  {
    std::vector<int> place(n_, -1);
    for (int k = 0; k < size(); ++k)
      place[order_[k]] = k;
    for (int rank = 1; rank < ranks_.size(); ++rank)
    {
      const SparseRowBlock theirs = rows_in_order(*A, order_, place, begin_[rank], begin_[rank + 1]);
      ranks_.send(theirs.begin, rank);
      ranks_.send(theirs.column, rank);
      ranks_.send(theirs.value, rank);
    }
    own = rows_in_order(*A, order_, place, 0, owned());
  }
  else
    own = {ranks_.receive<int>(0), ranks_.receive<int>(0), ranks_.receive<double>(0)};
  return made_of(own);
}

PetscOwned<Mat> RowDistribution::made_of(const SparseRowBlock &own) const
{
  Mat result = nullptr;
  require_petsc(MatCreate(ranks_.comm(), &result), "distribution");
  PetscOwned<Mat> made(result);
  require_petsc(MatSetSizes(result, owned(), owned(), size(), size()), "distribution");
  require_petsc(MatSetType(result, MATAIJ), "distribution");
  require_petsc(MatSeqAIJSetPreallocationCSR(result, own.begin.data(), own.column.data(), own.value.data()),
                "distribution"); // the one of the two that fits the number of ranks
  require_petsc(MatMPIAIJSetPreallocationCSR(result, own.begin.data(), own.column.data(), own.value.data()),
                "distribution");
  MatSetOption(result, MAT_SYMMETRIC, PETSC_TRUE);
  MatSetOption(result, MAT_SYMMETRY_ETERNAL, PETSC_TRUE);
  return made;
}

StoredRows RowDistribution::stored(Mat A) const
{
  std::error_code none;
  std::string     name  = (std::filesystem::temp_directory_path(none) / "gestell-rows-XXXXXX").string();
  const int       plain = mkstemp(name.data());
  StoredRows      file(plain < 0 ? nullptr : fdopen(plain, "w+b"));
  if (file)
    unlink(name.c_str());
  int good = file != nullptr;
  for (int i = 0; i < owned() && good; i += rows_at_once)
  {
    const SparseRowBlock block = own_rows(A, first() + i, std::min(rows_at_once, owned() - i));
    good = write(block.begin, file.get()) && write(block.column, file.get()) && write(block.value, file.get());
  }
  good = good && std::fflush(file.get()) == 0;
  MPI_Allreduce(MPI_IN_PLACE, &good, 1, MPI_INT, MPI_MIN, ranks_.comm());
  return good ? std::move(file) : nullptr;
}

PetscOwned<Mat> RowDistribution::loaded(const StoredRows &rows) const
{
  SparseRowBlock own;
  std::rewind(rows.get());
  for (int i = 0; i < owned(); i += rows_at_once)
  {
    const int        before = own.begin.back();
    std::vector<int> begin;
    read(begin, rows.get());
    for (std::size_t k = 1; k < begin.size(); ++k)
      own.begin.push_back(before + begin[k]);
    read(own.column, rows.get());
    read(own.value, rows.get());
  }
  return made_of(own);
}

SparseMatrix RowDistribution::collected(Mat A) const
{
  SparseRowBlock rows = own_rows(A, first(), owned());
  if (!ranks_.first())
  {
    ranks_.send(rows.begin, 0);
    ranks_.send(rows.column, 0);
    ranks_.send(rows.value, 0);
    return {};
  }
  std::vector<std::vector<int>> begin{std::move(rows.begin)};
  for (int rank = 1; rank < ranks_.size(); ++rank)
    begin.push_back(ranks_.receive<int>(rank));
  Eigen::VectorXi entries = Eigen::VectorXi::Zero(n_);
  for (int rank = 0; rank < ranks_.size(); ++rank)
    for (int k = begin_[rank]; k < begin_[rank + 1]; ++k)
      entries(order_[k]) = begin[rank][k - begin_[rank] + 1] - begin[rank][k - begin_[rank]];
  SparseMatrix result(n_, n_);
  result.reserve(entries);
  std::vector<std::pair<int, double>> column; // = row, as A is symmetric
  for (int rank = 0; rank < ranks_.size(); ++rank)
  {
    if (rank > 0)
      rows.column = ranks_.receive<int>(rank), rows.value = ranks_.receive<double>(rank);
    for (int k = begin_[rank]; k < begin_[rank + 1]; ++k)
    {
      column.clear();
      for (int a = begin[rank][k - begin_[rank]]; a < begin[rank][k - begin_[rank] + 1]; ++a)
        column.emplace_back(order_[rows.column[a]], rows.value[a]);
      std::sort(column.begin(), column.end());
      for (const auto &[i, value] : column)
        result.insert(i, order_[k]) = value;
    }
  }
  result.makeCompressed();
  return result;
}

MatrixXd RowDistribution::rows_of(int rank, const Eigen::Ref<const MatrixXd> &X) const
{
  MatrixXd rows(begin_[rank + 1] - begin_[rank], X.cols());
  for (Eigen::Index j = 0; j < X.cols(); ++j)
    for (Eigen::Index k = 0; k < rows.rows(); ++k)
      rows(k, j) = X(order_[begin_[rank] + k], j);
  return rows;
}

MatrixXd RowDistribution::deal_out(const Eigen::Ref<const MatrixXd> &X, int columns) const
{
  if (ranks_.first())
  {
    for (int rank = 1; rank < ranks_.size(); ++rank)
    {
      const MatrixXd theirs = rows_of(rank, X);
      ranks_.send(theirs.data(), theirs.size(), rank);
    }
    return rows_of(0, X);
  }
  MatrixXd own(owned(), columns);
  ranks_.receive(own.data(), own.size(), 0);
  return own;
}

void RowDistribution::collect(const Eigen::Ref<const MatrixXd> &rows, Eigen::Ref<MatrixXd> X) const
{
  if (ranks_.first())
    X.setZero();
  Eigen::VectorXd theirs;
  for (Eigen::Index j = 0; j < rows.cols(); ++j)
  {
    if (!ranks_.first())
    {
      ranks_.send(rows.col(j).data(), rows.rows(), 0);
      continue;
    }
    for (int k = 0; k < owned(); ++k)
      X(order_[k], j) = rows(k, j);
    for (int rank = 1; rank < ranks_.size(); ++rank)
    {
      theirs.resize(begin_[rank + 1] - begin_[rank]);
      ranks_.receive(theirs.data(), theirs.size(), rank);
      for (Eigen::Index k = 0; k < theirs.size(); ++k)
        X(order_[begin_[rank] + k], j) = theirs(k);
    }
  }
}

LocalRows::LocalRows(const RowDistribution &rows, const std::vector<Mat> &matrices)
    : first_(rows.first()), owned_(rows.owned())
{
  const auto remove_repetitions = [&]
  {
    std::sort(ghosts_.begin(), ghosts_.end());
    ghosts_.erase(std::unique(ghosts_.begin(), ghosts_.end()), ghosts_.end());
  };
  for (const Mat A : matrices)
    for (int i = first_; i < first_ + owned_; ++i)
    {
      PetscInt        count   = 0;
      const PetscInt *columns = nullptr;
      require_petsc(MatGetRow(A, i, &count, &columns, nullptr), "ghosts");
      std::copy_if(columns, columns + count, std::back_inserter(ghosts_),
                   [&](int j) { return j < first_ || j >= first_ + owned_; });
      MatRestoreRow(A, i, &count, &columns, nullptr);
      constexpr int often = 1 << 14; // rows after which repetitions go: they would take memory
      if (i % often == 0)
        remove_repetitions();
    }
  remove_repetitions();
  const PetscInt          *begin = nullptr; // of the ranks' rows
  std::vector<PetscSFNode> owners;
  MatGetOwnershipRanges(matrices.front(), &begin);
  int rank = 0;
  for (const int g : ghosts_)
  {
    while (g >= begin[rank + 1])
      ++rank;
    owners.push_back({rank, g - begin[rank]});
  }
  PetscSF exchange = nullptr;
  require_petsc(PetscSFCreate(PetscObjectComm(PetscObject(matrices.front())), &exchange), "ghosts");
  exchange_.reset(exchange);
  require_petsc(PetscSFSetGraph(exchange, owned_, int(owners.size()), nullptr, PETSC_COPY_VALUES, owners.data(),
                                PETSC_COPY_VALUES),
                "ghosts");
}

int LocalRows::local(int row) const
{
  return row >= first_ && row < first_ + owned_
             ? row - first_
             : owned_ + int(std::lower_bound(ghosts_.begin(), ghosts_.end(), row) - ghosts_.begin());
}

void LocalRows::add_product(Mat A, const MatrixXd &X, MatrixXd &Y) const
{
  const int                                                              width = int(X.cols());
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> all(count(), width);
  all.topRows(owned_) = X;
  complete(all.data(), width);
  const MatrixXd columns = all;
  for (int first = 0; first < owned_; first += rows_at_once)
  {
    const int      rows  = std::min(rows_at_once, owned_ - first);
    SparseRowBlock block = own_rows(A, first_ + first, rows);
    for (int &column : block.column)
      column = local(column);
    exact_product(Eigen::Map<const SparseMatrix>(count(), rows, block.begin.back(), block.begin.data(),
                                                 block.column.data(), block.value.data()),
                  columns, Y.middleRows(first, rows));
  }
}

fem::SparseMatrix LocalRows::part_of(Mat A) const
{
  std::vector<std::vector<std::pair<int, double>>> across(ghosts_.size()); // couplings of a ghost to own rows
  std::vector<int>                                 begin{0}, column;
  std::vector<double>                              value;
  for (int i = 0; i < owned_; ++i)
  {
    PetscInt           count   = 0;
    const PetscInt    *columns = nullptr;
    const PetscScalar *values  = nullptr;
    require_petsc(MatGetRow(A, first_ + i, &count, &columns, &values), "own rows");
    for (int a = 0; a < count; ++a)
      if (const int j = local(columns[a]); j < owned_)
        column.push_back(j), value.push_back(values[a]);
    for (int a = 0; a < count; ++a)
      if (const int j = local(columns[a]); j >= owned_)
      {
        column.push_back(j), value.push_back(0.5 * values[a]);
        across[j - owned_].emplace_back(i, 0.5 * values[a]);
      }
    MatRestoreRow(A, first_ + i, &count, &columns, &values);
    begin.push_back(int(column.size()));
  }
  for (const auto &row : across)
  {
    for (const auto &[i, v] : row)
      column.push_back(i), value.push_back(v);
    begin.push_back(int(column.size()));
  }
  return fem::SparseMatrix(SparseMatrix(
      Eigen::Map<const SparseMatrix>(count(), count(), begin.back(), begin.data(), column.data(), value.data())));
}

namespace
{

/// A type of MPI for a row of numbers.
class RowType
{
public:
  explicit RowType(int width)
  {
    if (width == 1)
      return;
    MPI_Type_contiguous(width, MPI_DOUBLE, &type_);
    MPI_Type_commit(&type_);
  }
  ~RowType()
  {
    if (type_ != MPI_DOUBLE)
      MPI_Type_free(&type_);
  }
  RowType(const RowType &)                = delete;
  RowType     &operator=(const RowType &) = delete;
  MPI_Datatype get() const { return type_; }

private:
  MPI_Datatype type_ = MPI_DOUBLE; // PETSc reduces a single number as such only
};

} // namespace

void LocalRows::complete(double *X, int width) const
{
  const RowType row(width);
  double *const ghosts = X + std::ptrdiff_t(owned_) * width;
  require_petsc(PetscSFBcastBegin(exchange_.get(), row.get(), X, ghosts, MPI_REPLACE), "ghosts");
  require_petsc(PetscSFBcastEnd(exchange_.get(), row.get(), X, ghosts, MPI_REPLACE), "ghosts");
}

void LocalRows::add_up(double *X, int width) const
{
  const RowType row(width);
  double *const ghosts = X + std::ptrdiff_t(owned_) * width;
  require_petsc(PetscSFReduceBegin(exchange_.get(), row.get(), ghosts, X, MPI_SUM), "ghosts");
  require_petsc(PetscSFReduceEnd(exchange_.get(), row.get(), ghosts, X, MPI_SUM), "ghosts");
}

} // namespace gestell::coupling
