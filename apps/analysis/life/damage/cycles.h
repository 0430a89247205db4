#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace gestell::apps
{

/// A closed hysteresis loop, or an open half of one, of a history x.
struct Cycle
{
  double       range = 0.; ///< |x(end) - x(begin)|, > 0
  double       mean  = 0.; ///< (x(begin) + x(end)) / 2
  double       count = 0.; ///< 1 for a closed cycle, 0.5 for a half cycle; times the repetitions of its block
  std::int64_t begin = 0;  ///< samples of its two turning points
  std::int64_t end   = 0;
};

struct TurningPoint
{
  double       value  = 0.;
  std::int64_t sample = 0;
};

/**
 * Rainflow count of a history that arrives sample by sample, with the four-point rule: of the turning points a, b, c, d
 * the inner pair is a closed cycle if
 *
 *     |c - b| <= |b - a|   and   |c - b| <= |d - c|.
 *
 * The turning points that close no cycle remain as the residue, in which ranges first grow, then shrink.  Memory:
 * the residue.  Plateaus and samples between turning points change nothing.
 */
class Rainflow
{
public:
  /// Closed cycles are appended to `closed`, which outlives this.
  explicit Rainflow(std::vector<Cycle> &closed) : closed_(&closed) {}

  void add(double value, std::int64_t sample);

  /// First sample, the turning points, last sample.
  const std::vector<TurningPoint> &residue() const { return residue_; }

private:
  std::vector<Cycle>       *closed_;
  std::vector<TurningPoint> residue_;
};

/// What the residue of the whole load counts.
enum class Residue
{
  half,    ///< each of its ranges as half a cycle (ASTM E1049-85, 5.4.4)
  repeated ///< the load repeats: closed cycles of a repetition that follows another (ISO 12110-2)
};

/// Consecutive samples of a history, repeated.
struct LoadBlock
{
  std::int64_t first       = 0;  ///< sample
  std::int64_t end         = 0;  ///< after the last one
  double       repetitions = 1.; ///< >= 1
};

/// Blocks one after another; one repetition of the load is all blocks with their repetitions.
struct LoadSequence
{
  std::vector<LoadBlock> blocks; ///< at least one, none empty, each after the samples of the one before
  Residue                residue = Residue::repeated;
};

/// The samples 0 to n - 1 once.
LoadSequence single_load(std::int64_t n, Residue residue);

/// @throws std::invalid_argument: no block, an empty one, samples beyond n or of the block before, repetitions < 1 or
/// not finite
void require_valid(const LoadSequence &load, std::int64_t n);

/**
 * Rainflow cycles of one repetition of `load`, with the transition cycles between blocks and between repetitions of a
 * block.  A block that follows itself leaves the residue as it found it, so that its N repetitions are its first plus
 * N - 1 times its second: the cost is that of each sample once, whatever N.  docs/theory/life.md (2).
 *
 * @param history  [n] samples, finite; the blocks of `load` are valid for n
 * @param cycles   emptied and filled
 */
void               count_cycles(const double *history, const LoadSequence &load, std::vector<Cycle> &cycles);
std::vector<Cycle> count_cycles(const Eigen::VectorXd &history, const LoadSequence &load);

/**
 * The history with extremes between samples: where x turns, the vertex of the parabola through three samples,
 *
 *     x_i - (x_i+1 - x_i-1)^2 / (8 (x_i+1 - 2 x_i + x_i-1)).
 *
 * Of a smooth history sampled n times a period extremes are too small by at most (pi/n)^2/2, parts of which change with
 * every shift of the history; these are exact to the fourth order.  Where the second difference of a neighbour is not
 * between half and twice its own, the history is not smooth and stays as it is.
 */
Eigen::VectorXd extremes_between_samples(const Eigen::VectorXd &history, const LoadSequence &load);

/// Least part that these vertices find of what samples miss: of a sine sampled ten times a period, below which the step
/// has a warning, they find 91 to 93 %.
constexpr double found_between_samples = 0.9;

/// Counts in classes of equal width: range upwards, mean to the right.
struct RangeMeanMatrix
{
  double          range_width = 0.; ///< class i: ranges of [i, i + 1) range_width; the last one is closed
  double          mean_begin  = 0.; ///< class j: means from mean_begin + j mean_width on
  double          mean_width  = 0.;
  Eigen::MatrixXd counts; ///< [range classes x mean classes], its sum is that of the cycles' counts
  Eigen::MatrixXd damage; ///< same size, sum of `weights`
};

/// @param weights  [cycles] damage of each, or empty: damage is zero
RangeMeanMatrix range_mean_matrix(const std::vector<Cycle> &cycles, const std::vector<double> &weights, int classes);

} // namespace gestell::apps
