#pragma once

#include "tests/support/small_system.h"

#include <vector>

namespace gestell::tests
{

/// M q'' + B q' + C q + sum_i beta_i w_i (w_i^T q)^3 = f(t), each cubic spring an element of one measure.
class CubicSystem : public SmallSystem
{
public:
  struct Spring
  {
    double beta;
    Vector w;
  };

  CubicSystem(Matrix mass, Matrix damping, Matrix stiffness, std::vector<Spring> springs)
      : SmallSystem(std::move(mass), std::move(damping), std::move(stiffness)), springs_(std::move(springs))
  {
    Matrix directions(M.rows(), Eigen::Index(springs_.size()));
    for (std::size_t i = 0; i < springs_.size(); ++i)
      directions.col(Eigen::Index(i)) = springs_[i].w;
    W = directions.sparseView();
  }

  std::vector<coupling::ForceBlock> blocks() const override
  {
    std::vector<coupling::ForceBlock> blocks;
    for (std::size_t i = 0; i < springs_.size(); ++i)
      blocks.push_back({int(i), 1});
    return blocks;
  }
  // no branches, nothing to remember
  Vector save_history() const override { return {}; }
  void   restore_history(const Vector &) override {}

  void force(const coupling::LocalState &state, Vector &p) const override
  {
    for (std::size_t i = 0; i < springs_.size(); ++i)
      p[i] = -springs_[i].beta * state.u[i] * state.u[i] * state.u[i];
  }
  void derivatives(const coupling::LocalState &state, Vector &p, Matrix &dp_du, Matrix &dp_dv) const override
  {
    force(state, p);
    for (std::size_t i = 0; i < springs_.size(); ++i)
    {
      dp_du(i, i) = -3. * springs_[i].beta * state.u[i] * state.u[i];
      dp_dv(i, i) = 0.;
    }
  }
  void tangent(const coupling::LocalState &state, double w_u, double, double, Vector &p, Matrix &dp) const override
  {
    force(state, p);
    dp.setZero();
    for (std::size_t i = 0; i < springs_.size(); ++i)
      dp(i, i) = -3. * w_u * springs_[i].beta * state.u[i] * state.u[i];
  }
  void tangent_blocks(const coupling::LocalState &state, double w_u, double w_v, double w_a, Vector &p,
                      Vector &blocks) const override
  {
    coupling::LocalForces::tangent_blocks(state, w_u, w_v, w_a, p, blocks);
  }

private:
  std::vector<Spring> springs_;
};

} // namespace gestell::tests
