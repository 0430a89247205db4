// Numbers in files: with a point, whatever the locale of a program into which an FMU was loaded.

#include "coupling/frame/matrix_market.h"
#include "coupling/frame/number_in_file.h"
#include "fem/values/temporary_directory.h"

#include <gtest/gtest.h>

#include <clocale>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <string>

namespace gestell::tests
{
namespace
{

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
    const std::string place = (folder_.path() / "de_DE.UTF-8").string();
    made_ = std::system(("localedef -i de_DE -f UTF-8 '" + place + "' > /dev/null 2>&1").c_str()) == 0;
    ::setenv("LOCPATH", folder_.path().c_str(), 1);
    made_ = made_ && std::setlocale(LC_NUMERIC, "de_DE.UTF-8");
  }
  ~DecimalComma()
  {
    std::setlocale(LC_NUMERIC, "C");
    ::unsetenv("LOCPATH");
  }
  bool made() const { return made_; }

private:
  fem::TemporaryDirectory folder_;
  bool                    made_;
};

TEST(NumberInFile, HasAPointWhateverTheLocale)
{
  const DecimalComma locale;
  if (!locale.made())
    GTEST_SKIP() << "localedef or its sources are not there";
  ASSERT_NE(std::strtod("0.25", nullptr), 0.25);
  EXPECT_EQ(split("0.25"), Split(0.25, ""));
  const fem::TemporaryDirectory folder;
  const std::string             file = (folder.path() / "a.mtx").string();
  const Eigen::MatrixXd         A    = Eigen::MatrixXd::Constant(1, 1, 1. / 3.);
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
