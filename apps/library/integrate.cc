#include "apps/library/integrate.h"

#include "coupling/integration/integration_methods.h"
#include "coupling/integration/system/second_order_system.h"
#include "fem/values/number_text.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace gestell
{
namespace
{

using Vector   = Eigen::VectorXd;
using Matrix   = Eigen::MatrixXd;
using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

Matrix matrix_of(const char *name, const std::vector<double> &numbers, int rows, int columns)
{
  if (numbers.size() != std::size_t(rows) * std::size_t(columns))
    throw std::invalid_argument("integrate: " + std::string(name) + " has " + std::to_string(numbers.size()) +
                                " numbers, needs " + std::to_string(rows) + " x " + std::to_string(columns));
  Matrix matrix = Eigen::Map<const RowMajor>(numbers.data(), rows, columns);
  if (!matrix.allFinite())
    throw std::invalid_argument("integrate: " + std::string(name) + " has a number that is not finite");
  return matrix;
}

struct DenseSolver : coupling::LinearSolver
{
  explicit DenseSolver(const Matrix &A) : lu(A) {}
  void solve(const Vector &f, Vector &x) const override { x = lu.solve(f); }

  Eigen::PartialPivLU<Matrix> lu;
};

/// The interfaces of an OwnSystem that integrators use.
class Adapter : public coupling::SecondOrderSystem, public coupling::LinearSystem, public coupling::LocalForces
{
public:
  explicit Adapter(const OwnSystem &own)
      : own_(own), M_(matrix_of("M", own.M, own.n, own.n)), B_(matrix_of("B", own.B, own.n, own.n)),
        C_(matrix_of("C", own.C, own.n, own.n)), W_(matrix_of("W", own.W, own.n, own.n_u).sparseView()),
        excitation_(own.n), f_(own.n), dp_du_(own.n_u, own.n_u), dp_dv_(own.n_u, own.n_u)
  {
    if (own.n_u > 0 && !own.forces)
      throw std::invalid_argument("integrate: n_u is " + std::to_string(own.n_u) +
                                  " without forces; give both or none");
    if (own.load)
      excitation_.set_rest(
          [this](double t, Vector &f)
          {
            own_.load(t, f_.data());
            f += f_;
          });
  }

  const coupling::LinearSystem &linear() const override { return *this; }
  const coupling::LocalForces  &forces() const override { return *this; }

  int  size() const override { return own_.n; }
  void mass_times(const Vector &x, Vector &y) const override { y.noalias() = M_ * x; }
  void damping_times(const Vector &x, Vector &y) const override { y.noalias() = B_ * x; }
  void stiffness_times(const Vector &x, Vector &y) const override { y.noalias() = C_ * x; }
  std::unique_ptr<coupling::LinearSolver> factorise(double w_M, double w_B, double w_C) const override
  {
    return std::make_unique<DenseSolver>(w_M * M_ + w_B * B_ + w_C * C_);
  }
  std::vector<coupling::SpectrumLine> spectrum() const override { return {}; }
  const coupling::Excitation         &excitation() const override { return excitation_; }
  bool                                dense_matrices(Matrix &M, Matrix &B, Matrix &C) const override
  {
    M = M_, B = B_, C = C_;
    return true;
  }
  std::string coordinate_name(int i) const override { return "q" + std::to_string(i); }

  const Eigen::SparseMatrix<double> &directions() const override { return W_; }
  void force(const coupling::LocalState &state, Vector &p) const override { derivatives(state, p, dp_du_, dp_dv_); }
  void tangent(const coupling::LocalState &state, double w_u, double w_v, double, Vector &p, Matrix &dp) const override
  {
    derivatives(state, p, dp_du_, dp_dv_);
    dp = w_u * dp_du_ + w_v * dp_dv_;
  }
  void derivatives(const coupling::LocalState &state, Vector &p, Matrix &dp_du, Matrix &dp_dv) const override
  {
    if (own_.n_u == 0)
      return;
    own_.forces(state.t, state.u.data(), state.v.data(), p.data(), by_rows_u().data(), by_rows_v().data());
    dp_du = by_rows_u_;
    dp_dv = by_rows_v_;
  }

private:
  RowMajor &by_rows_u() const { return by_rows_u_.setZero(own_.n_u, own_.n_u); }
  RowMajor &by_rows_v() const { return by_rows_v_.setZero(own_.n_u, own_.n_u); }

  const OwnSystem            &own_;
  Matrix                      M_, B_, C_;
  Eigen::SparseMatrix<double> W_;
  coupling::Excitation        excitation_;
  mutable Vector              f_;
  mutable Matrix              dp_du_, dp_dv_;
  mutable RowMajor            by_rows_u_, by_rows_v_;
};

Vector start_of(const char *name, const std::vector<double> &numbers, int n)
{
  return matrix_of(name, numbers, n, 1);
}

void require_grid(double end, double output_step)
{
  constexpr double most_rows = 1e8; // 0.8 GB for each coordinate; as the message below has it
  if (!(end > 0.) || !std::isfinite(end) || !(output_step > 0.) || !(end / output_step < most_rows))
    throw std::invalid_argument("integrate: end is " + short_text(end) + ", output_step " + short_text(output_step) +
                                "; both must be above zero, with at most 1e8 rows");
}

} // namespace

OwnMotion integrate(const OwnSystem &system, const std::vector<double> &q, const std::vector<double> &v,
                    const OwnMethod &method, double end, double output_step)
{
  if (system.n < 1 || system.n_u < 0)
    throw std::invalid_argument("integrate: n is " + std::to_string(system.n) + ", n_u " + std::to_string(system.n_u) +
                                "; n must be 1 or more, n_u 0 or more");
  require_grid(end, output_step);
  const Adapter adapter(system);
  if (!Eigen::FullPivLU<Matrix>(matrix_of("M", system.M, system.n, system.n)).isInvertible())
    throw std::invalid_argument("integrate: M is singular; give every coordinate a mass, or remove it");
  coupling::MethodOptions options = coupling::options_of(method.name, method.order);
  options.step                    = method.step == 0. && method.tolerance > 0. ? end : method.step;
  options.tolerance               = method.tolerance;
  const auto integrator           = coupling::make_integrator(adapter, options);
  Vector     q_t = start_of("q", q, system.n), v_t = start_of("v", v, system.n);
  integrator->begin(0., q_t, v_t);

  OwnMotion  motion;
  const long n_rows = std::lround(std::ceil(end / output_step * (1. - 1e-12)));
  for (long row = 0; row <= n_rows; ++row)
  {
    const double t = std::min(double(row) * output_step, end);
    while (integrator->time() < t)
      integrator->advance();
    if (row > 0)
      integrator->interpolate(t, q_t, v_t);
    motion.t.push_back(t);
    motion.q.insert(motion.q.end(), q_t.data(), q_t.data() + system.n);
    motion.v.insert(motion.v.end(), v_t.data(), v_t.data() + system.n);
  }
  return motion;
}

} // namespace gestell
