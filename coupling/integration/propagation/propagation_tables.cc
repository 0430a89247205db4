#include "coupling/integration/propagation/propagation_tables.h"

#include <cmath>

namespace gestell::coupling
{

namespace
{

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Gauss' points on [0, 1]: zeros of Legendre's polynomial by Newton.
std::vector<double> gauss_points(int s)
{
  std::vector<double> points(s);
  for (int i = 0; i < s; ++i)
  {
    double x = -std::cos(M_PI * (i + 0.75) / (s + 0.5));
    for (int k = 0; k < 50; ++k)
    {
      double p = 1., p_1 = 0.; // P_j, P_j-1
      for (int j = 0; j < s; ++j)
      {
        const double p_2 = p_1;
        p_1              = p;
        p                = ((2. * j + 1.) * x * p_1 - j * p_2) / (j + 1.);
      }
      const double slope = s * (x * p - p_1) / (x * x - 1.), step = p / slope;
      x -= step;
      if (std::abs(step) < 1e-16)
        break;
    }
    points[i] = 0.5 * (1. + x);
  }
  return points;
}

/// y += A x by blocks, A being 2 x 2 in every block; parts y_1, y_2 of one column.
inline void multiply(const Block2 &a, double x_1, double x_2, double &y_1, double &y_2)
{
  y_1 = a.a11 * x_1 + a.a12 * x_2;
  y_2 = a.a21 * x_1 + a.a22 * x_2;
}

} // namespace

MatrixXd reordered(const MatrixXd &by_blocks, int n_p)
{
  MatrixXd by_parts = MatrixXd::Zero(by_blocks.rows(), 2 * n_p);
  for (Index b = 0; b < by_blocks.cols() / 2; ++b)
  {
    by_parts.col(b)       = by_blocks.col(2 * b);
    by_parts.col(n_p + b) = by_blocks.col(2 * b + 1);
  }
  return by_parts;
}

ModalMeasures::ModalMeasures(const ModalBlocks &modes, const SecondOrderSystem &system)
    : blocks(modes.blocks), n_p((int(modes.blocks.size()) + 3) / 4 * 4), n_modal(modes.n_modal)
{
  blocks.resize(n_p, {ModalBlock::decaying, -1., -1.});
  const MatrixXd W          = MatrixXd(system.forces().directions());
  MatrixXd       G          = MatrixXd::Zero(2 * Index(modes.blocks.size()), modes.Q.rows());
  G.topRows(modes.G.rows()) = modes.G;
  read_u                    = reordered(W.transpose() * modes.Q, n_p).transpose();
  read_v                    = reordered(W.transpose() * modes.V, n_p).transpose();
  put                       = reordered((G * W).transpose(), n_p).transpose();
  constant                  = reordered((G * system.linear().excitation().constant()).transpose(), n_p).transpose();
}

ForceBasis ForceBasis::constant()
{
  return {MatrixXd::Ones(1, 1), {1.}};
}

ForceBasis ForceBasis::linear()
{
  ForceBasis basis{MatrixXd::Zero(2, 2), {1.}};
  basis.l << 1., -1., 0., 1.;
  return basis;
}

ForceBasis ForceBasis::gauss(int s)
{
  ForceBasis basis{MatrixXd::Zero(s, s), gauss_points(s)};
  for (int j = 0; j < s; ++j)
  {
    VectorXd polynomial = VectorXd::Zero(s);
    polynomial[0]       = 1.;
    for (int i = 0; i < s; ++i)
    {
      if (i == j)
        continue;
      const double inverse = 1. / (basis.points[j] - basis.points[i]);
      for (int m = s - 1; m >= 0; --m)
        polynomial[m] = inverse * ((m > 0 ? polynomial[m - 1] : 0.) - basis.points[i] * polynomial[m]);
    }
    basis.l.row(j) = polynomial;
  }
  basis.points.push_back(1.);
  return basis;
}

double ForceBasis::value(int j, double sigma) const
{
  double value = 0.;
  for (Index m = l.cols() - 1; m >= 0; --m)
    value = value * sigma + l(j, m);
  return value;
}

void StepTable::fill(const ModalMeasures &system, const ForceBasis &basis, double length)
{
  const int n_p = system.n_p, n_u = int(system.put.cols()), n_basis = basis.size(), n_points = int(basis.points.size());
  h = length;
  E.resize(n_p, 4);
  in.resize(2 * n_p, n_basis * n_u);
  constant.resize(2 * n_p);
  rows.resize(2 * n_p, n_points * 2 * n_u);
  row_constant.resize(n_points * 2 * n_u);
  S_u.resize(n_points * n_u, n_basis * n_u);
  S_v.resize(n_points * n_u, n_basis * n_u);
  weighted_.resize(2 * n_p, n_basis * n_u + 1);
  for (int i = 0; i < n_points; ++i)
  {
    for (int b = 0; b < n_p; ++b)
      fill_block(system, basis, i, b);
    const auto of_basis                                    = weighted_.leftCols(n_basis * n_u);
    const auto steady                                      = weighted_.col(n_basis * n_u);
    S_u.middleRows(i * n_u, n_u).noalias()                 = system.read_u.transpose() * of_basis;
    S_v.middleRows(i * n_u, n_u).noalias()                 = system.read_v.transpose() * of_basis;
    row_constant.segment(i * 2 * n_u, n_u).noalias()       = system.read_u.transpose() * steady;
    row_constant.segment(i * 2 * n_u + n_u, n_u).noalias() = system.read_v.transpose() * steady;
  }
  in       = weighted_.leftCols(n_basis * n_u);
  constant = weighted_.col(n_basis * n_u);
}

/// Fills the rows of block b up to point i of the basis; the last point is the end of the step.
void StepTable::fill_block(const ModalMeasures &system, const ForceBasis &basis, int i, int b)
{
  static constexpr double factorial[] = {1., 1., 2., 6., 24., 120., 720., 5040., 40320., 362880.};
  const int               n_u = int(system.put.cols()), n_basis = basis.size(), degree = int(basis.l.cols()) - 1;
  const int               one = b, two = system.n_p + b;
  const double            c = basis.points[i];
  Block2                  phi[10];
  phi_functions(system.blocks[b], c * h, degree + 1, phi);
  for (int r = 0; r < n_u; ++r) // rows: (E^T read)
  {
    const double u_1 = system.read_u(one, r), u_2 = system.read_u(two, r);
    const double v_1 = system.read_v(one, r), v_2 = system.read_v(two, r);
    const int    at_u = i * 2 * n_u + r, at_v = at_u + n_u;
    rows(one, at_u) = phi[0].a11 * u_1 + phi[0].a21 * u_2;
    rows(two, at_u) = phi[0].a12 * u_1 + phi[0].a22 * u_2;
    rows(one, at_v) = phi[0].a11 * v_1 + phi[0].a21 * v_2;
    rows(two, at_v) = phi[0].a12 * v_1 + phi[0].a22 * v_2;
  }
  for (int j = 0; j < n_basis; ++j)
  {
    Block2 w{0., 0., 0., 0.};
    double power = c * h;
    for (int m = 0; m <= degree; ++m, power *= c)
    {
      const double factor = basis.l(j, m) * factorial[m] * power;
      w.a11 += factor * phi[m + 1].a11;
      w.a12 += factor * phi[m + 1].a12;
      w.a21 += factor * phi[m + 1].a21;
      w.a22 += factor * phi[m + 1].a22;
    }
    for (int r = 0; r < n_u; ++r)
      multiply(w, system.put(one, r), system.put(two, r), weighted_(one, j * n_u + r), weighted_(two, j * n_u + r));
  }
  const Block2 steady{c * h * phi[1].a11, c * h * phi[1].a12, c * h * phi[1].a21, c * h * phi[1].a22};
  multiply(steady, system.constant[one], system.constant[two], weighted_(one, n_basis * n_u),
           weighted_(two, n_basis * n_u));
  E.row(b) << phi[0].a11, phi[0].a12, phi[0].a21, phi[0].a22; // the values at the end remain
}

void StepTable::carry(const VectorXd &x, VectorXd &x_end) const
{
  const auto n          = E.rows();
  x_end.head(n).array() = E.col(0).array() * x.head(n).array() + E.col(1).array() * x.tail(n).array();
  x_end.tail(n).array() = E.col(2).array() * x.head(n).array() + E.col(3).array() * x.tail(n).array();
}

void carry_inside(const ModalMeasures &system, const ForceBasis &basis, double tau, double h, const VectorXd &p,
                  VectorXd &x)
{
  const int    n_p = system.n_p, n_u = int(system.put.cols()), degree = int(basis.l.cols()) - 1;
  const double share         = tau / h;
  double       factorial[10] = {1.};
  for (int m = 1; m < 10; ++m)
    factorial[m] = factorial[m - 1] * m;
  for (int b = 0; b < n_p; ++b)
  {
    Block2 phi[10];
    phi_functions(system.blocks[b], tau, degree + 1, phi);
    const int one = b, two = n_p + b;
    double    y_1, y_2;
    multiply(phi[0], x[one], x[two], y_1, y_2);
    // x' = Lambda x + sum_m g_m (t/h)^m, each power with its phi function
    double power = tau;
    for (int m = 0; m <= degree; ++m, power *= share)
    {
      double g_1 = m == 0 ? system.constant[one] : 0., g_2 = m == 0 ? system.constant[two] : 0.;
      for (int r = 0; r < n_u; ++r)
      {
        double force = 0.;
        for (int j = 0; j < basis.size(); ++j)
          force += basis.l(j, m) * p[j * n_u + r];
        g_1 += force * system.put(one, r);
        g_2 += force * system.put(two, r);
      }
      double z_1, z_2;
      multiply(phi[m + 1], g_1, g_2, z_1, z_2);
      y_1 += factorial[m] * power * z_1;
      y_2 += factorial[m] * power * z_2;
    }
    x[one] = y_1;
    x[two] = y_2;
  }
}

} // namespace gestell::coupling
