#include "coupling/frame/matrix_market.h"

#include "coupling/frame/atomic_file.h"
#include "coupling/frame/number_in_file.h"
#include "coupling/integration/system/announced_size.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <map>
#include <sstream>
#include <stdexcept>
#include <utility>
#include <vector>

namespace gestell::coupling
{

namespace
{

using Matrix = Eigen::SparseMatrix<double>;

std::string lower_case(std::string text)
{
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return char(std::tolower(c)); });
  return text;
}

/// The file, line by line, with messages that contain the location.
class MatrixMarketReader
{
public:
  explicit MatrixMarketReader(const std::string &name) : name_(name), file_(name)
  {
    if (!file_)
      throw std::invalid_argument(name + ": cannot be read; check the path and its permissions");
    file_.seekg(0, std::ios::end);
    size_ = file_.tellg();
    file_.seekg(0);
  }

  /// Rejects more numbers than a file of this length can contain, each with a blank or a line end.
  void require_room(double numbers, const std::string &what) const
  {
    if (2. * numbers > double(size_) + 1.)
      fail(what + " do not fit in a file of " + std::to_string(size_) +
           " bytes; the file is truncated, or its header is wrong");
  }

  /// Refuses rows or columns that no file of this length has, see may_have_lines().
  void require_lines(std::int64_t lines, std::int64_t known, const char *what) const
  {
    if (!may_have_lines(lines, size_, known))
      fail("a matrix with " + std::to_string(lines) + " " + what + " does not fit in a file of " +
           std::to_string(size_) + " bytes; the file is truncated, or its header is wrong");
  }

  [[noreturn]] void fail(const std::string &expected) const
  {
    std::string shown = line_.substr(0, 60) + (line_.size() > 60 ? "..." : "");
    std::replace_if(
        shown.begin(), shown.end(), [](unsigned char c) { return !std::isprint(c); }, '?');
    throw std::invalid_argument(name_ + ":" + std::to_string(number_) + ": '" + shown + "': " + expected);
  }

  [[noreturn]] void fail_at_end(const std::string &expected) const
  {
    throw std::invalid_argument(name_ + ":" + std::to_string(number_) + ": the file ends here, but " + expected);
  }

  /// Next line, carriage return removed; false at the end.
  bool next()
  {
    if (!std::getline(file_, line_))
      return false;
    ++number_;
    if (!line_.empty() && line_.back() == '\r')
      line_.pop_back();
    if (line_.find('\0') != std::string::npos)
      fail("contains a zero byte; a MatrixMarket file is text");
    rest_ = line_.data();
    return true;
  }

  /// Next line that is neither empty nor a comment.
  bool next_entry()
  {
    while (next())
      if (const auto first = line_.find_first_not_of(" \t"); first != std::string::npos && line_[first] != '%')
        return true;
    return false;
  }

  const std::string &line() const { return line_; }
  long               number() const { return number_; }

  int integer(const char *expected)
  {
    char      *end;
    const long value = std::strtol(rest_, &end, 10);
    if (end == rest_ || value < 0 || value > std::numeric_limits<int>::max())
      fail(expected);
    rest_ = end;
    return int(value);
  }

  double real(const char *expected)
  {
    double      value = 0.;
    std::size_t n     = read_number(rest_, value) - rest_;
    if (rest_[n] == 'D' || rest_[n] == 'd') // an exponent of Fortran, 1.5D+03
    {
      rest_[n] = 'e';
      n        = read_number(rest_, value) - rest_;
    }
    if (n == 0)
      fail(expected);
    if (!std::isfinite(value))
      fail("its value is not a finite number; the program that wrote it failed, or divided by zero");
    rest_ += n;
    return value;
  }

  void end_of_line(const char *expected) const
  {
    for (const char *c = rest_; *c; ++c)
      if (!std::isspace(static_cast<unsigned char>(*c)))
        fail(expected);
  }

private:
  std::string   name_;
  std::ifstream file_;
  std::string   line_;
  char         *rest_   = nullptr;
  long          number_ = 0;
  std::int64_t  size_   = 0;
};

struct Header
{
  bool coordinate, symmetric;
};

Header read_header(MatrixMarketReader &reader)
{
  const char *expected = "expected the header line of a MatrixMarket file, "
                         "'%%MatrixMarket matrix coordinate|array real|integer general|symmetric'";
  if (!reader.next())
    reader.fail_at_end(expected);
  std::istringstream         words(reader.line());
  std::array<std::string, 5> word;
  for (auto &w : word)
    words >> w;
  for (auto &w : word)
    w = lower_case(w);
  if (word[0] != "%%matrixmarket" || word[1] != "matrix" || (word[2] != "coordinate" && word[2] != "array"))
    reader.fail(expected);
  if (word[3] == "pattern")
    reader.fail("a pattern has positions of entries but no values; write the matrix itself as real");
  if (word[3] != "real" && word[3] != "integer")
    reader.fail("only real and integer matrices are read, not '" + word[3] + "'");
  if (word[4] != "general" && word[4] != "symmetric")
    reader.fail("only general and symmetric matrices are read, not '" + word[4] + "'");
  return {word[2] == "coordinate", word[4] == "symmetric"};
}

using Entries = std::vector<Eigen::Triplet<double>>;

void add(Entries &entries, int row, int column, double value, bool symmetric)
{
  entries.emplace_back(row, column, value);
  if (symmetric && row != column)
    entries.emplace_back(column, row, value);
}

void read_coordinates(MatrixMarketReader &reader, int rows, int columns, int count, bool symmetric, Entries &entries)
{
  const char *expected = "expected 'row column value'";
  entries.reserve(std::size_t(count) * (symmetric ? 2 : 1));
  for (int k = 0; k < count; ++k)
  {
    if (!reader.next_entry())
      reader.fail_at_end(std::to_string(count) + " entries are announced, but " + std::to_string(k) + " were found");
    const int    row = reader.integer(expected), column = reader.integer(expected);
    const double value = reader.real(expected);
    reader.end_of_line(expected);
    if (row < 1 || row > rows || column < 1 || column > columns)
      reader.fail("row and column must be from 1 to " + std::to_string(rows) + " and " + std::to_string(columns));
    if (symmetric && column > row)
      reader.fail("a symmetric file contains the lower triangle, row >= column");
    add(entries, row - 1, column - 1, value, symmetric);
  }
}

void read_array(MatrixMarketReader &reader, int rows, int columns, bool symmetric, Entries &entries)
{
  for (int column = 0; column < columns; ++column)
    for (int row = symmetric ? column : 0; row < rows; ++row)
    {
      if (!reader.next_entry())
        reader.fail_at_end("values from row " + std::to_string(row + 1) + " of column " + std::to_string(column + 1) +
                           " on are missing");
      const double value = reader.real("expected one value");
      reader.end_of_line("expected one value");
      if (value != 0.)
        add(entries, row, column, value, symmetric);
    }
}

/// Reads the file again up to the first repeated entry and refuses it. The format gives each entry by row and column
/// and does not define the meaning of a second one (Boisvert, Pozo and Remington, The Matrix Market Exchange Formats:
/// Initial Design, NISTIR 5935, 1996).
[[noreturn]] void refuse_repeated(const std::string &file)
{
  MatrixMarketReader reader(file);
  read_header(reader);
  reader.next_entry(); // the sizes
  std::map<std::pair<int, int>, long> lines;
  while (reader.next_entry())
  {
    const int row = reader.integer("a row"), column = reader.integer("a column");
    const auto [first, is_new] = lines.try_emplace({row, column}, reader.number());
    if (!is_new)
      reader.fail(
          "row " + std::to_string(row) + ", column " + std::to_string(column) + " is in line " +
          std::to_string(first->second) +
          " already, and this format does not add duplicates; sum them before writing (in scipy: A.sum_duplicates())");
  }
  reader.fail_at_end("an entry was found twice before; the file is being changed while it is read");
}

} // namespace

Matrix read_matrix_market(const std::string &file, std::int64_t known_size)
{
  MatrixMarketReader reader(file);
  const Header       header   = read_header(reader);
  const char        *expected = header.coordinate ? "expected 'rows columns entries'" : "expected 'rows columns'";
  if (!reader.next_entry())
    reader.fail_at_end(std::string(expected + 9) + " is missing");
  const int rows = reader.integer(expected), columns = reader.integer(expected);
  const int count = header.coordinate ? reader.integer(expected) : 0;
  reader.end_of_line(expected);
  constexpr int largest_size = 20'000'000; // a number that is wrong would take all memory
  if (rows > largest_size || columns > largest_size)
    reader.fail("a matrix with more than " + std::to_string(largest_size) +
                " rows or columns is too large to compute; check the file");
  reader.require_lines(rows, known_size, "rows");
  reader.require_lines(columns, known_size, "columns");
  if (header.symmetric && rows != columns)
    reader.fail("a symmetric matrix must be square");
  if (header.coordinate)
    reader.require_room(3. * count, std::to_string(count) + " entries");
  else
    reader.require_room(double(rows) * columns / (header.symmetric ? 2. : 1.),
                        std::to_string(rows) + " x " + std::to_string(columns) + " values");

  Entries entries;
  if (header.coordinate)
    read_coordinates(reader, rows, columns, count, header.symmetric, entries);
  else
    read_array(reader, rows, columns, header.symmetric, entries);
  if (reader.next_entry())
    reader.fail("more entries than announced");
  Matrix A(rows, columns);
  A.setFromTriplets(entries.begin(), entries.end());
  if (static_cast<std::size_t>(A.nonZeros()) != entries.size())
    refuse_repeated(file);
  return A;
}

namespace
{

/// A file with head line and remark; finish() reports write errors.
class Output
{
public:
  Output(const std::string &file, const char *kind, const std::string &remark) : file_(file)
  {
    stream() << "%%MatrixMarket matrix " << kind << '\n';
    std::istringstream lines(remark);
    for (std::string line; std::getline(lines, line);)
      stream() << "% " << line << '\n';
  }
  std::ostream &stream() { return file_.stream(); }
  const char   *digits(double value)
  {
    const auto written = std::to_chars(digits_, digits_ + sizeof digits_ - 1, value, std::chars_format::general, 17);
    *written.ptr       = '\0';
    return digits_;
  }
  void finish() { file_.finish(); }

private:
  AtomicFile file_;
  char       digits_[40];
};

} // namespace

void write_matrix_market(const std::string &file, const Matrix &A, Symmetry symmetry, const std::string &remark)
{
  const bool lower = symmetry == Symmetry::symmetric;
  long       count = 0;
  for (int j = 0; j < A.outerSize(); ++j)
    for (Matrix::InnerIterator a(A, j); a; ++a)
      count += !lower || a.row() >= j;

  Output out(file, lower ? "coordinate real symmetric" : "coordinate real general", remark);
  out.stream() << A.rows() << ' ' << A.cols() << ' ' << count << '\n';
  for (int j = 0; j < A.outerSize(); ++j)
    for (Matrix::InnerIterator a(A, j); a; ++a)
      if (!lower || a.row() >= j)
        out.stream() << a.row() + 1 << ' ' << j + 1 << ' ' << out.digits(a.value()) << '\n';
  out.finish();
}

void write_matrix_market(const std::string &file, const Eigen::MatrixXd &A, const std::string &remark)
{
  Output out(file, "array real general", remark);
  out.stream() << A.rows() << ' ' << A.cols() << '\n';
  for (Eigen::Index j = 0; j < A.cols(); ++j)
    for (Eigen::Index i = 0; i < A.rows(); ++i)
      out.stream() << out.digits(A(i, j)) << '\n';
  out.finish();
}

} // namespace gestell::coupling
