#include "tests/support/step_map.h"

#include "coupling/integration/newmark/newmark.h"
#include "coupling/integration/newmark/wilson.h"
#include "tests/support/small_system.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>

namespace gestell::tests
{

using namespace coupling;
using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;

namespace
{

bool begins(const std::string &name, const std::string &with)
{
  return name.compare(0, with.size(), with) == 0;
}

SmallSystem oscillator(double zeta, double omega)
{
  return SmallSystem(Matrix::Identity(1, 1), Matrix::Constant(1, 1, 2. * zeta * omega),
                     Matrix::Constant(1, 1, omega * omega));
}

std::unique_ptr<OneStep> newmark(const SecondOrderSystem &system, Newmark::Options options, double h)
{
  options.step = h;
  return std::make_unique<Newmark>(system, options);
}

/// Rows and columns scaled by powers of two until they weigh alike (Parlett & Reinsch 1969): no rounding.
void balance(Matrix &A)
{
  for (int sweep = 0; sweep < 20; ++sweep)
    for (int i = 0; i < A.rows(); ++i)
    {
      const double own = std::abs(A(i, i));
      const double row = A.row(i).cwiseAbs().sum() - own, column = A.col(i).cwiseAbs().sum() - own;
      if (!(row > 0.) || !(column > 0.))
        continue;
      const double factor = std::exp2(std::round(0.5 * std::log2(row / column)));
      A.row(i) /= factor;
      A.col(i) *= factor;
    }
}

} // namespace

int bdf_order(const std::string &name)
{
  return begins(name, "bdf") ? name.at(3) - '0' : 0;
}

std::unique_ptr<OneStep> one_step_method(const std::string &name, const SecondOrderSystem &system, double h)
{
  const std::string value = name.substr(name.rfind('_') + 1);
  Newmark::Options  options;
  if (begins(name, "wilson"))
  {
    Wilson::Options wilson;
    wilson.theta = value == "(1+sqrt3)/2" ? 0.5 * (1. + std::sqrt(3.)) : std::stod(value);
    wilson.step  = h;
    return std::make_unique<Wilson>(system, wilson);
  }
  if (begins(name, "hht"))
    return newmark(system, Newmark::hht(std::stod(value)), h);
  if (begins(name, "galpha"))
    return newmark(system, Newmark::generalised_alpha(std::stod(value)), h);
  if (name == "central_difference" || begins(name, "newmark_explicit"))
    return newmark(system, Newmark::central_difference(), h);
  if (begins(name, "newmark_average"))
    return newmark(system, options, h);
  if (begins(name, "newmark_linear"))
    options.beta = 1. / 6.;
  else if (begins(name, "newmark_g")) // newmark_g<gamma>_b<beta>
  {
    options.gamma = std::stod(name.substr(9));
    options.beta  = std::stod(name.substr(name.find("_b") + 2));
  }
  else
    return nullptr;
  return newmark(system, options, h);
}

bool has_method(const std::string &name)
{
  return bdf_order(name) > 0 || one_step_method(name, oscillator(0., 1.), 1.);
}

Matrix step_map(const std::string &name, double zeta, double omega_h)
{
  const double      omega  = omega_h; // h = 1
  const SmallSystem system = oscillator(zeta, omega);
  if (const int order = bdf_order(name))
  {
    Bdf::Options options;
    options.order = order;
    options.step  = 1.;
    Bdf    bdf(system, options);
    Matrix map = Matrix::Zero(2 * order, 2 * order);
    for (int j = 0; j < 2 * order; ++j)
    {
      std::vector<Vector> q(order, Vector::Zero(1)), v = q;
      (j % 2 == 0 ? q : v)[j / 2][0] = j % 2 == 0 ? 1. : omega;
      bdf.begin(0., q, v);
      bdf.advance();
      map(0, j) = bdf.instant().q[0];
      map(1, j) = bdf.instant().v[0] / omega;
    }
    for (int i = 2; i < 2 * order; ++i)
      map(i, i - 2) = 1.;
    return map;
  }
  const auto method = one_step_method(name, system, 1.);
  Matrix     map(3, 3);
  for (int j = 0; j < 3; ++j)
  {
    Eigen::Vector3d unit = Eigen::Vector3d::Unit(j);
    method->begin(0., unit.segment(0, 1), omega * unit.segment(1, 1), (omega * omega) * unit.segment(2, 1));
    method->advance();
    map.col(j) << method->instant().q[0], method->instant().v[0] / omega, method->acceleration()[0] / (omega * omega);
  }
  return map;
}

std::vector<std::complex<double>> roots(Matrix map)
{
  balance(map);
  const auto values = Eigen::EigenSolver<Matrix>(map, false).eigenvalues().eval();
  return {values.begin(), values.end()};
}

double spectral_radius(const std::string &name, double zeta, double omega_h)
{
  double radius = 0.;
  for (const auto &root : roots(step_map(name, zeta, omega_h)))
    radius = std::max(radius, std::abs(root));
  return radius;
}

} // namespace gestell::tests
