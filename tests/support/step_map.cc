#include "tests/support/step_map.h"

#include "tests/support/small_system.h"

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

} // namespace

int bdf_order(const std::string &name)
{
  return begins(name, "bdf") ? name.at(3) - '0' : 0;
}

std::optional<MethodOptions> named_method(const std::string &name)
{
  const std::string value = name.substr(name.rfind('_') + 1);
  MethodOptions     options;
  const auto        of = [&](const char *method, const char *parameter, double x)
  {
    options.method = method;
    options.set(parameter, x);
  };
  if (const int order = bdf_order(name))
    options.order = order;
  else if (begins(name, "wilson"))
    of("wilson", "theta", value == "(1+sqrt3)/2" ? 0.5 * (1. + std::sqrt(3.)) : std::stod(value));
  else if (begins(name, "hht"))
    of("hht", "alpha", std::stod(value));
  else if (begins(name, "galpha"))
    of("generalised-alpha", "rho_inf", std::stod(value));
  else if (name == "central_difference")
    options.method = "central-difference";
  else if (begins(name, "newmark_g")) // newmark_g<gamma>_b<beta>
  {
    of("newmark", "gamma", std::stod(name.substr(9)));
    options.set("beta", std::stod(name.substr(name.find("_b") + 2)));
  }
  else if (begins(name, "newmark"))
    of("newmark", "beta", begins(name, "newmark_average") ? 0.25 : begins(name, "newmark_linear") ? 1. / 6. : 0.);
  else
    return std::nullopt;
  return options;
}

std::unique_ptr<OneStep> one_step_method(const std::string &name, const SecondOrderSystem &system, double h)
{
  MethodOptions options = named_method(name).value();
  options.step          = h;
  return std::unique_ptr<OneStep>(dynamic_cast<OneStep *>(make_integrator(system, options).release()));
}

Matrix step_map(const std::string &name, double zeta, double omega_h)
{
  const double      omega  = omega_h; // h = 1
  const SmallSystem system = oscillator(zeta, omega);
  if (const int order = bdf_order(name))
  {
    Bdf    bdf(system, {order, 1.});
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

} // namespace gestell::tests
