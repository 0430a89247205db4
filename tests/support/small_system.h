#pragma once

#include "coupling/integration/system/second_order_system.h"

#include <Eigen/Dense>

#include <algorithm>
#include <functional>

namespace gestell::tests
{

/// M q'' + B q' + C q = f(t) + w p(u, u'), u = w^T q, small and dense; p with its derivatives may be anything.
class SmallSystem : public coupling::SecondOrderSystem,
                    public coupling::LinearSystem,
                    public coupling::LocalForces,
                    public coupling::EventSystem,
                    public coupling::EnergyAccount
{
public:
  const coupling::LinearSystem  &linear() const override { return *this; }
  const coupling::LocalForces   &forces() const override { return *this; }
  const coupling::EventSystem   &events() const override { return *this; }
  coupling::EventSystem         &events() override { return *this; }
  const coupling::EnergyAccount &energy() const override { return *this; }

  using Vector = Eigen::VectorXd;
  using Matrix = Eigen::MatrixXd;
  /// p, dp/du, dp/dv
  using Law = std::function<void(double u, double v, double &p, double &dp_du, double &dp_dv)>;

  SmallSystem(Matrix mass, Matrix damping, Matrix stiffness)
      : M(std::move(mass)), B(std::move(damping)), C(std::move(stiffness)), W(M.rows(), 0),
        excitation_(static_cast<int>(M.rows()))
  {
  }

  /// f_t(t), any function.
  void set_load(std::function<Vector(double)> load)
  {
    excitation_.set_rest([load](double t, Vector &f) { f += load(t); });
  }
  coupling::Excitation &loads() { return excitation_; }

  void set_law(const Vector &w, Law law_of_force)
  {
    W   = Matrix(w).sparseView();
    law = std::move(law_of_force);
  }

  int  size() const override { return static_cast<int>(M.rows()); }
  void mass_times(const Vector &x, Vector &y) const override { y.noalias() = M * x; }
  void damping_times(const Vector &x, Vector &y) const override { y.noalias() = B * x; }
  void stiffness_times(const Vector &x, Vector &y) const override { y.noalias() = C * x; }

  std::unique_ptr<coupling::LinearSolver> factorise(double w_M, double w_B, double w_C) const override
  {
    struct Dense : coupling::LinearSolver
    {
      explicit Dense(const Matrix &a) : lu(a) {}
      void                        solve(const Vector &f, Vector &x) const override { x = lu.solve(f); }
      Eigen::PartialPivLU<Matrix> lu;
    };
    return std::make_unique<Dense>(w_M * M + w_B * B + w_C * C);
  }
  std::vector<coupling::SpectrumLine> spectrum() const override { return {}; }
  const coupling::Excitation         &excitation() const override { return excitation_; }
  bool                                dense_matrices(Matrix &mass, Matrix &damping, Matrix &stiffness) const override
  {
    mass = M, damping = B, stiffness = C;
    return true;
  }

  const Eigen::SparseMatrix<double> &directions() const override { return W; }
  void                               force(const coupling::LocalState &state, Vector &p) const override
  {
    double dp_du, dp_dv;
    if (law)
      law(state.u[0], state.v[0], p[0], dp_du, dp_dv);
  }
  void tangent(const coupling::LocalState &state, double w_u, double w_v, double, Vector &p, Matrix &dp) const override
  {
    double dp_du, dp_dv;
    law(state.u[0], state.v[0], p[0], dp_du, dp_dv);
    dp(0, 0) = w_u * dp_du + w_v * dp_dv;
  }
  /// One block of all measures, in a matrix that is kept: steps are watched for what they take from the heap.
  void tangent_blocks(const coupling::LocalState &state, double w_u, double w_v, double w_a, Vector &p,
                      Vector &blocks) const override
  {
    tangent_.setZero(W.cols(), W.cols());
    tangent(state, w_u, w_v, w_a, p, tangent_);
    for (const coupling::HeldMeasure &h : held())
    {
      tangent_.row(h.measure).setZero();
      tangent_.col(h.measure).setZero();
    }
    std::copy_n(tangent_.data(), tangent_.size(), blocks.data());
  }
  void derivatives(const coupling::LocalState &state, Vector &p, Matrix &dp_du, Matrix &dp_dv) const override
  {
    if (law)
      law(state.u[0], state.v[0], p[0], dp_du(0, 0), dp_dv(0, 0));
  }
  void follow_history(bool) override {}

  Vector save_history() const override { return Vector::Constant(1, transitions); }
  void   restore_history(const Vector &saved) override { transitions = static_cast<int>(saved[0]); }
  void   start(const coupling::LocalState &) override {}
  void   accept(const coupling::LocalState &) override {}

  // One guard: u rising through `level`; after each transition it watches the other direction.
  int  n_guards() const override { return watched ? 1 : 0; }
  void guard_values(const coupling::LocalState &state, Vector &g) const override
  {
    if (watched)
      g[0] = state.u[0] - level;
  }
  coupling::GuardCrossing crossing(int) const override
  {
    return transitions % 2 == 0 ? coupling::GuardCrossing::rising : coupling::GuardCrossing::falling;
  }
  coupling::ActiveGuard guard(int) const override { return {"oscillator", transitions % 2 == 0 ? "up" : "down"}; }
  void                  transition(int, const coupling::LocalState &) override { ++transitions; }

  double stored(const coupling::LocalState &) const override { return 0.; }
  void   power(const coupling::LocalState &state, const Vector &p, double &input, double &dissipated) const override
  {
    input      = 0.;
    dissipated = -p.dot(state.v);
  }
  std::string coordinate_name(int i) const override { return "q" + std::to_string(i); }

  Matrix                      M, B, C;
  Eigen::SparseMatrix<double> W;
  Law                         law;
  bool                        watched     = false;
  double                      level       = 0.;
  int                         transitions = 0;

private:
  coupling::Excitation excitation_;
  mutable Matrix       tangent_;
};

/// A force of the displacement alone, with its slope.
inline SmallSystem::Law law_of(std::function<double(double)> force, std::function<double(double)> slope)
{
  return [force = std::move(force), slope = std::move(slope)](double u, double, double &p, double &dp_du, double &dp_dv)
  {
    p     = force(u);
    dp_du = slope(u);
    dp_dv = 0.;
  };
}

} // namespace gestell::tests
