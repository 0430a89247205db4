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

/// A run that can be evaluated inside its last step.
class SampledRun
{
public:
  virtual ~SampledRun() = default;
  /// The signals at t in the last step, including its end.
  virtual void evaluate(double t, SignalSample &sample) = 0;
};

/// How densely steps are sampled.
struct Sampling
{
  bool   inside   = false; ///< long steps compared with the motion: sample inside each step, not only at its ends
  double shortest = 1e300; ///< [s] between samples, enough for the fastest motion; 1e300: no fast modes
};

/**
 * Smallest and largest values of all signals in a run, or after a given instant.
 *
 * Steps are sampled at their ends, or in four pieces.  The fourth divided difference of five adjacent samples estimates
 * the error of a peak from parabolas through three of them.  If it exceeds a share epsilon of the range of the signal,
 *
 *     |f[t_0 ... t_4]| D^4 > epsilon (max - min),   D: the longest piece between them
 *
 * (a sine of amplitude A, of theta rad in a piece: A theta^4/24, and a parabola misses its peak by A theta^4/32 at
 * most), every piece is halved, down to a sixteenth of the step and to `shortest`.  Therefore extremes are those of the
 * dense output within that share, even for long steps.
 *
 * If the extremum of a parabola through three samples exceeds the values so far, the dense output is evaluated there
 * and the parabola refined.  If a signal approaches zero between samples by half or more, the same is done for its
 * square: the magnitude of a vector that passes close to zero, for example of a joint force, has a sharp minimum, but
 * its square is smooth.
 */
class SignalExtremes
{
public:
  /// @param from  [s] instant after which extremes are evaluated, see RunOptions
  SignalExtremes(SampledRun &run, const Sampling &sampling, const std::vector<Signal> &signals, double from,
                 std::vector<SignalSummary> &summaries);

  /// Signals that are monitored after that event start at the next restart().
  void on_event(const std::string &event);
  /// The motion continues from here independently of the samples before: at the start, or after events.
  void restart(const SignalSample &at);
  /// A step from the last sample to `end`.
  void step(double end);
  /// A value that was computed for another purpose.
  void see(const SignalSample &sample);

  /// Sample at the end of the last step, or at the restart of the motion.
  const SignalSample &last() const { return samples_[n_ - 1]; }
  bool                begun() const { return n_ > 0; }
  /// Rate [1/s] there, from the parabola through the last three samples; nan: there are fewer.
  double slope(std::size_t signal) const;
  bool   watched(std::size_t signal) const { return watched_[signal] != 0; }
  bool   reached() const { return open_ != 0; } ///< the instant after which extremes are evaluated
  /// Restarts the extremes of a signal at the last sample.
  void reset_extremes(std::size_t signal);

  void exchange(StateArchive &archive);

private:
  /// The largest (sign 1) or smallest (-1) value of a signal, or of its square with the sign kept.
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
  std::vector<SignalSample>   samples_; ///< the first n_ are valid: up to three before the last step, then its own
  SignalSample                probe_;   ///< scratch
  std::vector<char>           watched_; ///< signals whose extremes are evaluated already
  std::vector<char>           anew_;    ///< signals that start at the next restart()
  std::vector<int>            like_;    ///< index of the first signal of the same unit
  int                         n_ = 0, begin_ = 0;
  char                        open_ = 0; ///< from_ is in the past
};

} // namespace gestell::coupling
