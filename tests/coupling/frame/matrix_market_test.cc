#include "coupling/frame/matrix_market.h"
#include "tests/support/refusal.h"

#include <gtest/gtest.h>

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace gestell
{
namespace
{

using coupling::read_matrix_market;
using coupling::write_matrix_market;
using Eigen::MatrixXd;

class MatrixMarket : public ::testing::Test
{
protected:
  std::string file =
      (std::filesystem::temp_directory_path() / ("gestell_" + std::to_string(getpid()) + ".mtx")).string();
  void TearDown() override { std::filesystem::remove(file); }

  MatrixXd read(const std::string &text)
  {
    std::ofstream(file) << text;
    return read_matrix_market(file);
  }
  std::string message_of(const std::string &text)
  {
    return tests::refusal([&] { read(text); });
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
  says("", "0", "head line");
  says("2 2 1\n1 1 1\n", "1", "head line");
  says("%%MatrixMarket matrix coordinate complex general\n", "1", "not 'complex'");
  says("%%MatrixMarket matrix coordinate pattern symmetric\n", "1", "write the matrix itself");
  says("%%MatrixMarket matrix coordinate real hermitian\n", "1", "not 'hermitian'");
  says(head + "1 1 1\n1 1 1e999\n", "3", "not a finite number");
  says("%%MatrixMarket matrix coordinate real skew-symmetric\n", "1", "not 'skew-symmetric'");
  says(head + "2 2\n", "2", "rows columns entries");
  says(head, "1", "rows columns entries");
  says(head + "2 2 2\n1 1 1\n", "3", "2 entries are announced and 1 were found");
  says(head + "2 2 1\n1 3 1\n", "3", "count from 1 to");
  says(head + "2 2 1\n0 1 1\n", "3", "count from 1 to");
  says(head + "2 2 1\n1 1 nan\n", "3", "not a finite number");
  says(head + "2 2 1\n1 1 -inf\n", "3", "not a finite number");
  says(head + "2000000000 2000000000 1\n1 1 1\n", "2", "more than 20000000 rows or columns");
  says(head + "20000000 20000000 2000000000\n1 1 1\n", "2", "cannot stand in a file of");
  says("%%MatrixMarket matrix array real general\n2000000 2000000\n1\n", "2", "cannot stand in a file of");
  says("\x80\x01 junk\n", "1", "'?? junk': expected the head line");
  says(head + "2 2 1\n1 1 1 1\n", "3", "row column value");
  says(head + "2 2 1\n1 one 1\n", "3", "row column value");
  says(head + "2 2 1\n1 1 0x10\n", "3", "row column value");
  says(head + "2 2 1\n1 1 1,5\n", "3", "row column value");
  says(head + "2 2 1\n1 1 1\n2 2 1\n", "4", "more entries");
  says("%%MatrixMarket matrix coordinate real symmetric\n2 2 1\n1 2 1\n", "3", "lower triangle");
  says("%%MatrixMarket matrix coordinate real symmetric\n2 3 1\n1 1 1\n", "2", "square");
  says("%%MatrixMarket matrix array real general\n2 2\n1\n2\n3\n", "5", "column 2");
  says(head + "2 2 3\n1 1 1\n% of the second element\n2 2 1\n1 1 2\n", "6", "column 1 stands in line 3 already");
  says("%%MatrixMarket matrix coordinate real symmetric\n2 2 3\n1 1 1\n2 1 1\n2 1 1\n", "5", "add up");
  EXPECT_THROW(read_matrix_market(file + ".absent"), std::invalid_argument);
}

} // namespace
} // namespace gestell
