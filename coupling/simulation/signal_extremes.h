#pragma once

#include "coupling/machine/machine_model.h"
#include "coupling/simulation/run_result.h"

#include <cmath>
#include <string>
#include <vector>

namespace gestell::coupling
{

class StateArchive;

/// All signals at an instant.
struct SignalSample
{
  double              t = 0.;
  std::vector<double> values;

  void exchange(StateArchive &archive);
};

/// A run whose last step can be looked into.
class SampledRun
{
public:
  virtual ~SampledRun() = default;
  /// The signals at t in the last step, its end included.
  virtual void evaluate(double t, SignalSample &sample) = 0;
};

/// How closely steps are looked into.
struct Sampling
{
  bool   inside   = false; ///< steps may be long against the motion: look into each, not at its ends alone
  double shortest = 1e300; ///< [s] between samples: nothing that signals show is faster; 1e300: no step has such modes
};

/**
 * Smallest and largest values of all signals in a run, or from an instant on.
 *
 * Steps are sampled at their ends, or in four pieces.  Where the fourth divided difference of five neighbours says that
 * parabolas through three of them miss a peak by more than a share epsilon of what the signal ranges over,
 *
 *     |f[t_0 ... t_4]| D^4 > epsilon (max - min),   D: the longest piece between them
 *
 * (a sine of amplitude A, of theta rad in a piece: A theta^4/24, and a parabola misses its peak by A theta^4/32 at
 * most), every piece is halved, up to a sixteenth of the step and to `shortest`: extremes are those of the dense output
 * to that share, however long the steps are.
 *
 * Where a parabola through three samples turns beyond what was seen, the dense output itself is evaluated and the
 * parabola drawn closer.  Where a signal nears zero between them by half and more, this is done of its square, too: the
 * length of a vector that passes close to zero, as the resultant of a joint, turns in far less than a step, its square
 * does not.
 */
class SignalExtremes
{
public:
  /// @param from  [s] instant from which on they count, see RunOptions
  SignalExtremes(SampledRun &run, const Sampling &sampling, const std::vector<Signal> &signals, double from,
                 std::vector<SignalSummary> &summaries);

  /// Signals that are watched from that event on count from the next restart() on.
  void on_event(const std::string &event);
  /// The motion goes on from there, and what was before says nothing about it: the start, or the last of some events.
  void restart(const SignalSample &at);
  /// A step from the last sample to `end`.
  void step(double end);
  /// A value that was looked up for another purpose.
  void see(const SignalSample &sample);

  /// At the end of the last step, or where the motion restarted.
  const SignalSample &last() const { return samples_[n_ - 1]; }
  bool                begun() const { return n_ > 0; }
  /// Rate [1/s] there, of the parabola through the last three samples; nan: there are fewer.
  double slope(std::size_t signal) const;
  bool   watched(std::size_t signal) const { return watched_[signal] != 0; }
  bool   reached() const { return open_ != 0; } ///< the instant from which on extremes count
  /// Extremes of a signal count from the last sample on.
  void reset_extremes(std::size_t signal);

  void exchange(StateArchive &archive);

private:
  /// The largest (sign 1) or smallest value (-1) of a signal, or of its square, sign kept.
  struct Sought
  {
    std::size_t signal;
    double      sign;
    bool        square;

    double of(double value) const { return sign * (square ? value * std::abs(value) : value); }
  };

  void   open(double t);
  bool   counts(std::size_t signal) const { return open_ && watched_[signal]; }
  void   append(double t);
  void   divide(double begin, double end);
  void   halve(int first);
  void   refine(double shortest);
  void   keep_the_last();
  bool   rough(int first) const;
  double range(std::size_t signal) const;
  void   turn(int middle);
  void   turn(const Sought &sought, int middle);
  bool   nears_zero(const Sought &sought, int middle) const;
  void   search(const Sought &sought, int middle);
  void   see(std::size_t signal, double t, double value);

  SampledRun                 &run_;
  Sampling                    sampling_;
  const std::vector<Signal>  &signals_;
  double                      from_; ///< [s]
  std::vector<SignalSummary> &summaries_;
  std::vector<SignalSample>   samples_; ///< the first n_ count: up to three before the last step, then its own
  SignalSample                probe_;   ///< scratch
  std::vector<char>           watched_; ///< signals whose extremes count already
  std::vector<char>           anew_;    ///< those that count from the next restart() on
  std::vector<int>            like_;    ///< number of the first signal of the same unit
  int                         n_ = 0, begin_ = 0;
  char                        open_ = 0; ///< from_ lies behind
};

} // namespace gestell::coupling
