#pragma once

#include "tests/random_machines/judge.h"
#include "tests/random_machines/trial.h"

namespace gestell::tests
{

constexpr char beyond_history[] = "extreme beyond the history"; ///< a kind of finding

/// What is judged of one motion by itself: signals, extremes, friction, contacts, joints, energy.
class History
{
public:
  /// @param dense    with many rows
  /// @param summary  of the same run with few rows, whose extremes are judged
  /// @param tolerance  of controlled steps; 0: steps are fixed
  History(const RandomMachine &machine, const std::string &way, const Told &dense, const Told &summary,
          double tolerance);

  std::vector<Finding> judge();

private:
  void   find(const std::string &kind, const std::string &what, double value, double bound);
  void   finite();
  void   extremes();
  void   extreme(int column, double sign, double reported, double t_told);
  void   frictions();
  void   contacts();
  void   joints();
  void   energy();
  double range(int column) const;
  bool   rests() const;
  bool   held(const std::string &signal) const;
  bool   between_rows(double t) const;

  const RandomMachine &machine_;
  std::string          way_;
  const Told          &dense_, &summary_;
  bool                 accurate_;
  double               tolerance_;
  std::vector<Finding> findings_;
};

} // namespace gestell::tests
