#include "coupling/frame/petsc_binary.h"

#include "coupling/frame/matrix_file.h"
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

using Eigen::MatrixXd;

class PetscBinary : public ::testing::Test
{
protected:
  std::string file =
      (std::filesystem::temp_directory_path() / ("gestell_" + std::to_string(getpid()) + ".petsc")).string();
  void TearDown() override { std::filesystem::remove(file); }

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
    return tests::refusal([&] { coupling::read_petsc_matrix(file); });
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

TEST_F(PetscBinary, IsToldFromMatrixMarketByItsContent)
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
  says("", "cut off");
  says("0012", "cut off");
  says("00127b4e 00000001" + one, "a vector of PETSc");
  says("00127b50 00000002", "cut off");
  says("89484446 0d0a1a0a", "it begins with");
  const std::string head = "00127b50 00000001 00000002 00000001";
  says(head + "00000001 00000000", "cut off");
  says(head + "00000001 00000000" + one + zero, "numbers are complex");
  says(head + "00000001 00000000" + one + head + "00000001 00000000" + one, "file of its own");
  says(head + "00000001 00000002" + one, "a column is 2; it must be from 0 to 1");
  says(head + "00000003 00000000" + one, "entries of a row");
  says(head + "00000002 00000000" + one, "2 entries together, but 1");
  says(head + "00000001 00000000 7ff8000000000000", "of row 1 and column 1, is not a finite number");
  says("00127b50 ffffffff 00000002 00000001", "number of rows is -1");
  EXPECT_THROW(coupling::read_petsc_matrix(file + ".absent"), std::invalid_argument);
}

} // namespace
} // namespace gestell
