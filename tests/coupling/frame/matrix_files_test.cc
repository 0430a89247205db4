// Matrices in files: MatrixMarket and PETSc's binary form; numbers with a point, whatever the locale of a program into
// which an FMU was loaded.

#include "coupling/frame/matrix_file.h"
#include "coupling/frame/matrix_market.h"
#include "coupling/frame/number_in_file.h"
#include "coupling/frame/petsc_binary.h"
#include "tests/support/program.h"
#include "tests/support/refusal.h"
#include "tests/support/test.h"

#include <clocale>

namespace gestell::tests
{
namespace
{

using coupling::read_matrix_market;
using coupling::write_matrix_market;
using Eigen::MatrixXd;

class MatrixMarket : public ::testing::Test
{
protected:
  Folder      folder{"matrices"};
  std::string file = (folder / "A").string();

  MatrixXd read(const std::string &text)
  {
    std::ofstream(file) << text;
    return read_matrix_market(file);
  }
  std::string message_of(const std::string &text)
  {
    return refusal([&] { read(text); });
  }
};

TEST_F(MatrixMarket, ASymmetricFileGivesBothTriangles)
{
  const MatrixXd A =
      read("%%MatrixMarket matrix coordinate real symmetric\n% springs\n\n2 2 3\n1 1 2.5\n2 1 -1e3\n2 2 4\n");
  EXPECT_EQ(A, (MatrixXd(2, 2) << 2.5, -1e3, -1e3, 4.).finished());
}

TEST_F(MatrixMarket, AGeneralFileIsTakenAsItIs)
{
  const MatrixXd A = read("%%MatrixMarket matrix coordinate integer general\r\n2 3 2\r\n1 3 7\r\n2 1 -2\r\n");
  EXPECT_EQ(A, (MatrixXd(2, 3) << 0., 0., 7., -2., 0., 0.).finished());
}

TEST_F(MatrixMarket, ArraysRunDownTheColumns)
{
  EXPECT_EQ(read("%%MatrixMarket matrix array real general\n2 2\n1\n2\n3\n4\n"),
            (MatrixXd(2, 2) << 1., 3., 2., 4.).finished());
  EXPECT_EQ(read("%%MatrixMarket matrix array real symmetric\n2 2\n1\n2\n4\n"),
            (MatrixXd(2, 2) << 1., 2., 2., 4.).finished());
}

TEST_F(MatrixMarket, TakesExponentsOfFortranIndentedCommentsAndAnyCaseOfTheHead)
{
  EXPECT_EQ(read("%%matrixmarket MATRIX Array Integer General\n  % of another program\n2 1\n-3\n4\n"),
            (MatrixXd(2, 1) << -3., 4.).finished());
  EXPECT_EQ(read("%%MatrixMarket matrix coordinate real general\n1 1 1\n1 1 -2.5D-03\n"),
            (MatrixXd(1, 1) << -2.5e-3).finished());
}

TEST_F(MatrixMarket, WhatIsWrittenDenseIsReadBitByBit)
{
  const MatrixXd A = MatrixXd::Random(3, 2) / 3.;
  write_matrix_market(file, A, "dense");
  EXPECT_EQ(MatrixXd(read_matrix_market(file)), A);
}

TEST_F(MatrixMarket, WhatIsWrittenIsReadBitByBit)
{
  Eigen::SparseMatrix<double> A(3, 3);
  A.coeffRef(0, 0) = 1. / 3.;
  A.coeffRef(2, 1) = A.coeffRef(1, 2) = -1e-300;
  A.coeffRef(2, 2)                    = 123456789.123456789;
  for (const auto symmetry : {coupling::Symmetry::general, coupling::Symmetry::symmetric})
  {
    write_matrix_market(file, A, symmetry, "two\nlines");
    EXPECT_EQ(MatrixXd(read_matrix_market(file)), MatrixXd(A));
  }
}

TEST_F(MatrixMarket, ErrorsNameFileLineAndRemedy)
{
  const std::string head = "%%MatrixMarket matrix coordinate real general\n";
  const auto        says = [&](const std::string &text, const std::string &line, const std::string &words)
  {
    const std::string message = message_of(text);
    EXPECT_EQ(message.find(file + ":" + line + ": "), 0u) << message;
    EXPECT_NE(message.find(words), std::string::npos) << message;
  };
  says("", "0", "header line");
  says("2 2 1\n1 1 1\n", "1", "header line");
  says("%%MatrixMarket matrix coordinate complex general\n", "1", "not 'complex'");
  says("%%MatrixMarket matrix coordinate pattern symmetric\n", "1", "write the matrix itself");
  says("%%MatrixMarket matrix coordinate real hermitian\n", "1", "not 'hermitian'");
  says(head + "1 1 1\n1 1 1e999\n", "3", "not a finite number");
  says("%%MatrixMarket matrix coordinate real skew-symmetric\n", "1", "not 'skew-symmetric'");
  says(head + "2 2\n", "2", "rows columns entries");
  says(head, "1", "rows columns entries");
  says(head + "2 2 2\n1 1 1\n", "3", "2 entries are announced, but 1 were found");
  says(head + "2 2 1\n1 3 1\n", "3", "must be from 1 to");
  says(head + "2 2 1\n0 1 1\n", "3", "must be from 1 to");
  says(head + "2 2 1\n1 1 nan\n", "3", "not a finite number");
  says(head + "2 2 1\n1 1 -inf\n", "3", "not a finite number");
  says(head + "2000000000 2000000000 1\n1 1 1\n", "2", "more than 20000000 rows or columns");
  says(head + "20000000 20000000 2000000000\n1 1 1\n", "2", "not fit in a file of");
  says("%%MatrixMarket matrix array real general\n2000000 2000000\n1\n", "2", "not fit in a file of");
  says("\x80\x01 junk\n", "1", "'?? junk': expected the header line");
  says(head + "2 2 1\n1 1 1 1\n", "3", "row column value");
  says(head + "2 2 1\n1 one 1\n", "3", "row column value");
  says(head + "2 2 1\n1 1 0x10\n", "3", "row column value");
  says(head + "2 2 1\n1 1 1,5\n", "3", "row column value");
  says(head + "2 2 1\n1 1 1\n2 2 1\n", "4", "more entries");
  says("%%MatrixMarket matrix coordinate real symmetric\n2 2 1\n1 2 1\n", "3", "lower triangle");
  says("%%MatrixMarket matrix coordinate real symmetric\n2 3 1\n1 1 1\n", "2", "square");
  says("%%MatrixMarket matrix array real general\n2 2\n1\n2\n3\n", "5", "column 2");
  says(head + "2 2 3\n1 1 1\n% of the second element\n2 2 1\n1 1 2\n", "6", "column 1 is in line 3 already");
  says("%%MatrixMarket matrix coordinate real symmetric\n2 2 3\n1 1 1\n2 1 1\n2 1 1\n", "5", "sum them");
  EXPECT_THROW(read_matrix_market(file + ".absent"), std::invalid_argument);
}

class PetscBinary : public ::testing::Test
{
protected:
  Folder      folder{"matrices"};
  std::string file = (folder / "A").string();

  /// Writes bytes given in hexadecimal; blanks do not count.
  void write(const std::string &digits) const
  {
    std::ofstream out(file, std::ios::binary);
    std::string   pair;
    for (const char c : digits)
      if (c != ' ')
        if (pair += c; pair.size() == 2)
        {
          out.put(char(std::stoi(pair, nullptr, 16)));
          pair.clear();
        }
  }
  std::string message() const
  {
    return refusal([&] { coupling::read_petsc_matrix(file); });
  }
};

// [[1, 0, -2], [0, 0, 0.5]] by hand: class 0x00127b50, IEEE 754 doubles.
const std::string one = "3ff0000000000000", minus_two = "c000000000000000", half = "3fe0000000000000",
                  zero = "0000000000000000";
const MatrixXd known   = (MatrixXd(2, 3) << 1., 0., -2., 0., 0., 0.5).finished();

TEST_F(PetscBinary, ReadsTheFormatByTheByte)
{
  write("00127b50 00000002 00000003 00000003  00000002 00000001  00000000 00000002 00000002" + one + minus_two + half);
  EXPECT_EQ(MatrixXd(coupling::read_petsc_matrix(file)), known);
  EXPECT_EQ(MatrixXd(coupling::read_matrix_file(file)), known);
}

TEST_F(PetscBinary, ReadsIntegersOfEightBytes)
{
  const auto wide = [](const std::string &x) { return " 0000000000" + x; };
  write(wide("127b50") + wide("000002") + wide("000003") + wide("000003") + wide("000002") + wide("000001") +
        wide("000000") + wide("000002") + wide("000002") + one + minus_two + half);
  EXPECT_EQ(MatrixXd(coupling::read_matrix_file(file)), known);
}

TEST_F(PetscBinary, ReadsDenseMatricesRowByRow)
{
  write("00127b50 00000002 00000003 ffffffff" + one + zero + minus_two + zero + zero + half);
  EXPECT_EQ(MatrixXd(coupling::read_petsc_matrix(file)), known);
}

TEST_F(PetscBinary, WhatIsWrittenIsReadBitByBit)
{
  MatrixXd A(3, 2);
  A << 1. / 3., 0., -1e-300, 123456789.123456789, 0., 5e-324;
  coupling::write_petsc_matrix(file, Eigen::SparseMatrix<double>(A.sparseView(0., 0.)));
  EXPECT_EQ(MatrixXd(coupling::read_petsc_matrix(file)), A);
  coupling::write_petsc_matrix(file, A);
  EXPECT_EQ(MatrixXd(coupling::read_petsc_matrix(file)), A);
}

TEST_F(PetscBinary, IsDistinguishedFromMatrixMarketByItsContent)
{
  coupling::write_matrix_market(file, known, "");
  EXPECT_EQ(MatrixXd(coupling::read_matrix_file(file)), known);
  EXPECT_FALSE(coupling::is_petsc_file(file));
}

TEST_F(PetscBinary, ErrorsNameFilePlaceAndRemedy)
{
  const auto says = [&](const std::string &bytes, const std::string &words)
  {
    write(bytes);
    const std::string text = message();
    EXPECT_EQ(text.find(file + ": byte "), 0u) << text;
    EXPECT_NE(text.find(words), std::string::npos) << text;
  };
  says("", "truncated");
  says("0012", "truncated");
  says("00127b4e 00000001" + one, "a PETSc vector");
  says("00127b50 00000002", "truncated");
  says("89484446 0d0a1a0a", "it begins with");
  const std::string head = "00127b50 00000001 00000002 00000001";
  says(head + "00000001 00000000", "truncated");
  says(head + "00000001 00000000" + one + zero, "numbers are complex");
  says(head + "00000001 00000000" + one + head + "00000001 00000000" + one, "in a separate file");
  says(head + "00000001 00000002" + one, "a column is 2; it must be from 0 to 1");
  says(head + "00000003 00000000" + one, "entries of a row");
  says(head + "00000002 00000000" + one, "2 entries in total, but 1");
  says(head + "00000001 00000000 7ff8000000000000", "of row 1 and column 1, is not a finite number");
  says("00127b50 ffffffff 00000002 00000001", "number of rows is -1");
  EXPECT_THROW(coupling::read_petsc_matrix(file + ".absent"), std::invalid_argument);
}

/// The number at the begin of a text, and what is left behind it.
std::pair<double, std::string> split(const char *text)
{
  double            value = -1.;
  const std::string rest  = coupling::read_number(text, value);
  return {value, rest};
}

using Split = std::pair<double, std::string>;

TEST(NumberInFile, IsReadUpToWhereItEnds)
{
  EXPECT_EQ(split("0.25"), Split(0.25, ""));
  EXPECT_EQ(split(" \t+1e+3 4"), Split(1000., " 4"));
  EXPECT_EQ(split("-2.5D-03"), Split(-2.5, "D-03")); // which who reads Fortran looks at
  EXPECT_EQ(split("1,5"), Split(1., ",5"));
  EXPECT_EQ(split("0x10"), Split(0., "x10")); // strtod takes all of it
}

/// A locale with a decimal comma, made for the time of a test.
class DecimalComma
{
public:
  DecimalComma()
  {
    const std::string place = (folder_ / "de_DE.UTF-8").string();
    made_ = std::system(("localedef -i de_DE -f UTF-8 '" + place + "' > /dev/null 2>&1").c_str()) == 0;
    ::setenv("LOCPATH", (folder_ / "").c_str(), 1);
    made_ = made_ && std::setlocale(LC_NUMERIC, "de_DE.UTF-8");
  }
  ~DecimalComma()
  {
    std::setlocale(LC_NUMERIC, "C");
    ::unsetenv("LOCPATH");
  }
  bool made() const { return made_; }

private:
  Folder folder_{"locale"};
  bool   made_;
};

TEST(NumberInFile, HasAPointWhateverTheLocale)
{
  const DecimalComma locale;
  if (!locale.made())
    GTEST_SKIP() << "localedef or its sources are not there";
  ASSERT_NE(std::strtod("0.25", nullptr), 0.25);
  EXPECT_EQ(split("0.25"), Split(0.25, ""));
  const Folder          folder("matrices");
  const std::string     file = (folder / "a.mtx").string();
  const Eigen::MatrixXd A    = Eigen::MatrixXd::Constant(1, 1, 1. / 3.);
  coupling::write_matrix_market(file, A, "");
  EXPECT_EQ(Eigen::MatrixXd(coupling::read_matrix_market(file)), A);
}

TEST(NumberInFile, OfAnySizeHasItsLimit)
{
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(split("1e-400 "), Split(0., " "));
  EXPECT_EQ(split("1e400"), Split(infinity, ""));
  EXPECT_EQ(split("-1E400"), Split(-infinity, ""));
  EXPECT_EQ(split("4.9e-324"), Split(std::numeric_limits<double>::denorm_min(), ""));
  EXPECT_TRUE(std::isnan(split("nan").first));
}

TEST(NumberInFile, IsNoneWhereNoneBegins)
{
  for (const char *text : {"", "  ", "one", "+-1", ".", "-"})
  {
    double value = -1.;
    EXPECT_EQ(coupling::read_number(text, value), text);
    EXPECT_EQ(value, -1.);
  }
}

} // namespace
} // namespace gestell::tests
