#pragma once

#include "tests/support/small_system.h"

namespace gestell::tests
{

/// The play of clearance_system() as three branches, left at located events.
class PlaySystem final : public SmallSystem
{
public:
  explicit PlaySystem(const SmallSystem &smooth) : SmallSystem(smooth)
  {
    law = [this](double u, double, double &p, double &dp_du, double &dp_dv)
    {
      const int side = follows ? branch : side_of(u);
      p              = side - (side != 0 ? u : 0.);
      dp_du          = side != 0 ? -1. : 0.;
      dp_dv          = 0.;
    };
  }
  void   follow_history(bool follow) override { follows = follow; }
  Vector save_history() const override { return Vector::Constant(1, branch); }
  void   restore_history(const Vector &saved) override { branch = int(saved[0]); }
  void   start(const coupling::LocalState &state) override { branch = side_of(state.u[0]); }
  int    n_guards() const override { return branch == 0 ? 2 : 1; }
  void   guard_values(const coupling::LocalState &state, Vector &g) const override
  {
    g[0] = branch == 0 ? state.u[0] - 1. : 1. - branch * state.u[0];
    if (branch == 0)
      g[1] = -state.u[0] - 1.;
  }
  coupling::GuardCrossing crossing(int) const override { return coupling::GuardCrossing::rising; }
  coupling::ActiveGuard   guard(int) const override { return {"play", branch == 0 ? "touches" : "leaves"}; }
  void transition(int guard, const coupling::LocalState &) override { branch = branch != 0 ? 0 : guard == 0 ? 1 : -1; }

private:
  static int side_of(double u) { return u > 1. ? 1 : u < -1. ? -1 : 0; }
  int        branch  = 0;
  bool       follows = false;
};

} // namespace gestell::tests
