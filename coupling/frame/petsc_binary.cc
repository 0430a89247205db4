#include "coupling/frame/petsc_binary.h"

#include "coupling/frame/atomic_file.h"
#include "coupling/integration/system/announced_size.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <limits>
#include <stdexcept>

namespace gestell::coupling
{

namespace
{

using Matrix = Eigen::SparseMatrix<double>;

// petscmat.h, petscvec.h: what kind of object follows.
constexpr std::int64_t matrix_class = 1211216, vector_class = 1211214, first_class = 1211211, last_class = 1211250;
constexpr std::int64_t dense = -1; // instead of the number of entries

template <typename Unsigned>
Unsigned from_big_endian(const unsigned char *bytes)
{
  Unsigned value = 0;
  for (std::size_t i = 0; i < sizeof(Unsigned); ++i)
    value = Unsigned(value << 8) | bytes[i];
  return value;
}

/// The file from its beginning, with messages that contain the position.
class PetscReader
{
public:
  explicit PetscReader(const std::string &name) : name_(name), file_(name, std::ios::binary)
  {
    if (!file_)
      throw std::invalid_argument(name + ": cannot be read; check the path and its permissions");
    file_.seekg(0, std::ios::end);
    size_ = file_.tellg();
    file_.seekg(0);
  }

  [[noreturn]] void fail(const std::string &what) const
  {
    throw std::invalid_argument(name_ + ": byte " + std::to_string(at_) + ": " + what);
  }

  void use_wide_integers() { wide_ = true; }

  std::int64_t integer() { return wide_ ? std::int64_t(take<std::uint64_t>()) : std::int32_t(take<std::uint32_t>()); }

  /// Entry of row i and column j, counted from 0.
  double real(int i, int j)
  {
    const auto bits = take<std::uint64_t>();
    double     value;
    std::memcpy(&value, &bits, sizeof value);
    if (!std::isfinite(value))
      fail("the preceding value, of row " + std::to_string(i + 1) + " and column " + std::to_string(j + 1) +
           ", is not a finite number; the program that wrote it failed, or divided by zero");
    return value;
  }

  /// Refuses rows or columns that no file of this length has, see may_have_lines().
  void require_lines(std::int64_t lines, std::int64_t known, const char *what) const
  {
    if (!may_have_lines(lines, size_, known))
      fail("a matrix with " + std::to_string(lines) + " " + what + " does not fit in a file of " +
           std::to_string(size_) + " bytes; the file is truncated, or its header is wrong");
  }

  /// Refuses a file that is not as long as `integers` and `reals` more.
  void require_left(std::int64_t integers, std::int64_t reals, const std::string &shape) const
  {
    const double needed = double(integers) * (wide_ ? 8. : 4.) + 8. * double(reals), left = double(size_ - at_);
    const auto   count = [](double bytes) { return std::to_string(std::int64_t(bytes)); };
    if (left == needed)
      return;
    std::string reason = "the file is truncated";
    if (left == needed + 8. * double(reals))
      reason = "its numbers are complex; save the real matrix";
    else if (left > needed)
      reason = "the file contains more than one object; save each matrix in a separate file";
    fail(shape + " takes " + count(needed) + " more bytes, but " + count(left) + " follow: " + reason);
  }

private:
  template <typename Unsigned>
  Unsigned take()
  {
    unsigned char bytes[sizeof(Unsigned)];
    file_.read(reinterpret_cast<char *>(bytes), sizeof bytes);
    if (!file_)
      fail("the file ends here; it is truncated");
    at_ += sizeof bytes;
    return from_big_endian<Unsigned>(bytes);
  }

  std::string   name_;
  std::ifstream file_;
  std::int64_t  at_ = 0, size_ = 0;
  bool          wide_ = false;
};

void read_head(PetscReader &reader)
{
  std::int64_t kind = reader.integer();
  if (kind == 0) // upper half of an integer of 8 bytes
  {
    kind = reader.integer();
    reader.use_wide_integers();
  }
  if (kind == vector_class)
    reader.fail("it is a PETSc vector; a matrix is needed");
  if (kind != matrix_class)
    reader.fail("it begins with " + std::to_string(kind) + ", a PETSc matrix with " + std::to_string(matrix_class));
}

int checked(const PetscReader &reader, std::int64_t value, std::int64_t from, std::int64_t below, const char *what)
{
  if (value < from || value >= below)
    reader.fail(std::string(what) + " is " + std::to_string(value) + "; it must be from " + std::to_string(from) +
                " to " + std::to_string(below - 1));
  return int(value);
}

Matrix read_dense(PetscReader &reader, int rows, int columns, const std::string &shape)
{
  reader.require_left(0, std::int64_t(rows) * columns, shape);
  Eigen::MatrixXd A(rows, columns);
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < columns; ++j)
      A(i, j) = reader.real(i, j);
  return A.sparseView(0., 0.);
}

Matrix read_sparse(PetscReader &reader, int rows, int columns, int entries, const std::string &shape)
{
  reader.require_left(std::int64_t(rows) + entries, entries, shape);
  Eigen::SparseMatrix<double, Eigen::RowMajor> A(rows, columns);
  std::int64_t                                 sum = 0;
  for (int i = 0; i < rows; ++i)
  {
    sum += checked(reader, reader.integer(), 0, std::int64_t(columns) + 1, "the number of entries of a row");
    A.outerIndexPtr()[i + 1] = int(std::min<std::int64_t>(sum, entries));
  }
  if (sum != entries)
    reader.fail("the rows have " + std::to_string(sum) + " entries in total, but " + std::to_string(entries) +
                " are announced");
  A.resizeNonZeros(entries);
  for (int k = 0; k < entries; ++k)
    A.innerIndexPtr()[k] = checked(reader, reader.integer(), 0, columns, "a column");
  for (int i = 0; i < rows; ++i)
    for (int k = A.outerIndexPtr()[i]; k < A.outerIndexPtr()[i + 1]; ++k)
      A.valuePtr()[k] = reader.real(i, A.innerIndexPtr()[k]);
  Eigen::SparseMatrix<double> by_columns = A; // also puts entries in order
  return by_columns;
}

class Writer
{
public:
  explicit Writer(const std::string &name) : file_(name) {}
  void integer(std::int64_t value) { put(std::uint32_t(std::int32_t(value))); }
  void real(double value)
  {
    std::uint64_t bits;
    std::memcpy(&bits, &value, sizeof bits);
    put(bits);
  }
  void finish() { file_.finish(); }

private:
  template <typename Unsigned>
  void put(Unsigned value)
  {
    char bytes[sizeof value];
    for (std::size_t i = sizeof value; i > 0; --i, value = Unsigned(value >> 8))
      bytes[i - 1] = char(value & 0xff);
    file_.stream().write(bytes, sizeof bytes);
  }

  AtomicFile file_;
};

} // namespace

Matrix read_petsc_matrix(const std::string &file, std::int64_t known_size)
{
  constexpr std::int64_t most = std::numeric_limits<int>::max();
  PetscReader            reader(file);
  read_head(reader);
  const int rows    = checked(reader, reader.integer(), 0, most, "the number of rows");
  const int columns = checked(reader, reader.integer(), 0, most, "the number of columns");
  reader.require_lines(rows, known_size, "rows");
  reader.require_lines(columns, known_size, "columns");
  const auto entries = reader.integer();
  const auto shape   = "a matrix of " + std::to_string(rows) + " x " + std::to_string(columns);
  if (entries == dense)
    return read_dense(reader, rows, columns, shape);
  return read_sparse(reader, rows, columns, checked(reader, entries, 0, most, "the number of entries"),
                     shape + " with " + std::to_string(entries) + " entries");
}

void write_petsc_matrix(const std::string &file, const Matrix &A)
{
  const Eigen::SparseMatrix<double, Eigen::RowMajor> by_rows = A;
  Writer                                             out(file);
  for (const std::int64_t x :
       {matrix_class, std::int64_t(A.rows()), std::int64_t(A.cols()), std::int64_t(A.nonZeros())})
    out.integer(x);
  for (int i = 0; i < by_rows.rows(); ++i)
    out.integer(by_rows.outerIndexPtr()[i + 1] - by_rows.outerIndexPtr()[i]);
  for (int k = 0; k < by_rows.nonZeros(); ++k)
    out.integer(by_rows.innerIndexPtr()[k]);
  for (int k = 0; k < by_rows.nonZeros(); ++k)
    out.real(by_rows.valuePtr()[k]);
  out.finish();
}

void write_petsc_matrix(const std::string &file, const Eigen::MatrixXd &A)
{
  Writer out(file);
  for (const std::int64_t x : {matrix_class, std::int64_t(A.rows()), std::int64_t(A.cols()), dense})
    out.integer(x);
  for (Eigen::Index i = 0; i < A.rows(); ++i)
    for (Eigen::Index j = 0; j < A.cols(); ++j)
      out.real(A(i, j));
  out.finish();
}

bool is_petsc_file(const std::string &file)
{
  unsigned char bytes[8] = {};
  std::ifstream in(file, std::ios::binary);
  in.read(reinterpret_cast<char *>(bytes), sizeof bytes);
  const auto head = from_big_endian<std::uint32_t>(bytes);
  const auto kind = head != 0 ? head : from_big_endian<std::uint32_t>(bytes + 4);
  return kind >= first_class && kind <= last_class;
}

} // namespace gestell::coupling
