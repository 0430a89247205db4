#pragma once

#include "tests/support/element_probe.h"
#include "tests/support/test.h"

namespace gestell::tests
{

using mechanism::ForceLaw;

/// An element driven along a prescribed motion u(t), u'(t).
struct Drive
{
  std::string                  name;
  std::shared_ptr<ForceLaw>    element;
  std::function<Probe(double)> motion;
  double                       end;
  std::set<std::string>        kinds; ///< of all events on the way
};

inline std::ostream &operator<<(std::ostream &out, const Drive &d)
{
  return out << d.name;
}

/// offset + slope t + amplitude sin(omega t)
inline Probe swinging(double t, double offset, double slope, double amplitude, double omega)
{
  Probe probe =
      probe1(offset + slope * t + amplitude * std::sin(omega * t), slope + amplitude * omega * std::cos(omega * t));
  probe.t = t;
  return probe;
}

/// Were a kink of a law not a guard, or a transition wrong, the branch in the history would part from the one of the
/// motion, and so would their forces.
inline void expect_guards_to_tell_every_branch(const Drive &drive)
{
  const ForceLaw            &element  = *drive.element;
  const mechanism::Branches &branches = *element.branches();
  constexpr int              steps    = 20000;
  const double               h        = drive.end / steps;
  Eigen::VectorXd            history  = started(element, drive.motion(0.));
  std::set<std::string>      kinds;
  for (int n = 0; n < steps; ++n)
  {
    double       from = n * h;
    const double to   = (n + 1) * h;
    for (bool again = true; again;)
    {
      again = false;
      for (int i = 0; i < branches.n_guards(history.data()) && !again; ++i)
      {
        const auto value = [&](double t) { return past(element, i, drive.motion(t), history.data()); };
        if (value(to) <= 0.)
          continue;
        double open = from, due = to;
        while (value(open) < 0. && due - open > 1e-14)
        {
          const double middle               = 0.5 * (open + due);
          (value(middle) < 0. ? open : due) = middle;
        }
        kinds.insert(branches.guards(history.data())[i].kind);
        branches.transition(i, drive.motion(due).motion(true), history.data());
        from  = due;
        again = true;
      }
    }
    const Probe probe = drive.motion(to);
    branches.accept(probe.motion(true), history.data());
    const Eigen::VectorXd by_motion  = force(element, probe, history.data(), false);
    const Eigen::VectorXd by_history = force(element, probe, history.data(), true);
    // z_max is located to 1e-14 s, about the rounding of u: 1e-16 m times 9e9 N/m; the rest is equal but for rounding.
    ASSERT_LE((by_motion - by_history).norm(), 1e-12 * by_motion.norm() + 1e-4) << drive.name << ", t = " << to;
    ASSERT_NEAR(element.stored_energy(probe.motion(true), history.data()),
                element.stored_energy(probe.motion(false), history.data()), 1e-12);
    for (int i = 0; i < static_cast<int>(element.quantities().size()); ++i)
    {
      const double expected = element.quantity(i, probe.motion(false), history.data());
      ASSERT_NEAR(element.quantity(i, probe.motion(true), history.data()), expected, 1e-12 * std::abs(expected) + 1e-4);
    }
  }
  EXPECT_EQ(kinds, drive.kinds);
}

} // namespace gestell::tests
