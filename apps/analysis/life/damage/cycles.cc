#include "apps/analysis/life/damage/cycles.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <stdexcept>
#include <string>

namespace gestell::apps
{

namespace
{

Cycle cycle_between(const TurningPoint &a, const TurningPoint &b, double count)
{
  return {std::abs(b.value - a.value), 0.5 * (a.value + b.value), count, a.sample, b.sample};
}

/// Counts what is appended to `cycles` while `append` runs `times` times.
template <typename Append>
void append_times(std::vector<Cycle> &cycles, double times, const Append &append)
{
  const std::size_t first = cycles.size();
  append();
  for (std::size_t k = first; k < cycles.size(); ++k)
    cycles[k].count *= times;
}

/// Samples within a rise or a fall are skipped: most are, and add() costs ten times as much as this.
void add_turning_points(const double *history, const LoadBlock &block, Rainflow &rainflow)
{
  std::int64_t i = block.first;
  rainflow.add(history[i], i);
  const std::int64_t last = block.end - 1;
  while (i < last)
  {
    while (i < last && history[i + 1] >= history[i])
      ++i;
    rainflow.add(history[i], i);
    while (i < last && history[i + 1] <= history[i])
      ++i;
    rainflow.add(history[i], i);
  }
}

} // namespace

void Rainflow::add(double value, std::int64_t sample)
{
  auto &r = residue_;
  if (!r.empty() && value == r.back().value)
    return;
  const std::size_t n = r.size();
  if (n >= 2 && (value > r[n - 1].value) == (r[n - 1].value > r[n - 2].value))
    r.back() = {value, sample}; // the last point was none of return
  else
    r.push_back({value, sample});
  while (r.size() >= 4)
  {
    const std::size_t end   = r.size();
    const double      inner = std::abs(r[end - 2].value - r[end - 3].value);
    if (inner > std::abs(r[end - 3].value - r[end - 4].value) || inner > std::abs(r[end - 1].value - r[end - 2].value))
      return;
    closed_->push_back(cycle_between(r[end - 3], r[end - 2], 1.));
    r[end - 3] = r[end - 1];
    r.resize(end - 2);
  }
}

LoadSequence single_load(std::int64_t n, Residue residue)
{
  return {{{0, n, 1.}}, residue};
}

void require_valid(const LoadSequence &load, std::int64_t n)
{
  if (load.blocks.empty())
    throw std::invalid_argument("the load has no block; give at least one history.");
  for (std::size_t b = 0; b < load.blocks.size(); ++b)
  {
    const LoadBlock  &block = load.blocks[b];
    const std::string name  = "block " + std::to_string(b + 1) + " of the load ";
    if (block.first < (b > 0 ? load.blocks[b - 1].end : 0) || block.end > n || block.first >= block.end)
      throw std::invalid_argument(name + "has the samples " + std::to_string(block.first) + " to " +
                                  std::to_string(block.end) + ", but there are " + std::to_string(n) +
                                  "; give at least one sample of the history, after those of the block before.");
    if (!(block.repetitions >= 1.) || !std::isfinite(block.repetitions))
      throw std::invalid_argument(name + "is repeated " + std::to_string(block.repetitions) +
                                  " times; give a finite number of at least 1.");
  }
}

void count_cycles(const double *history, const LoadSequence &load, std::vector<Cycle> &cycles)
{
  cycles.clear();
  std::vector<std::vector<TurningPoint>> residues;
  for (const LoadBlock &block : load.blocks)
    append_times(cycles, block.repetitions,
                 [&]
                 {
                   Rainflow inside(cycles);
                   add_turning_points(history, block, inside);
                   residues.push_back(inside.residue());
                 });
  // docs/theory/life.md (2): cycles that close inside a block close wherever it stands; only residues meet each other
  Rainflow   outside(cycles);
  const auto repetition_of_load = [&]
  {
    for (std::size_t b = 0; b < residues.size(); ++b)
    {
      const double repetitions = load.blocks[b].repetitions;
      const auto   once        = [&]
      {
        for (const TurningPoint &point : residues[b])
          outside.add(point.value, point.sample);
      };
      append_times(cycles, 1., once);
      if (repetitions > 1.)
        append_times(cycles, repetitions - 1., once);
    }
  };
  const std::size_t closed = cycles.size();
  repetition_of_load();
  if (load.residue == Residue::repeated)
  {
    cycles.resize(closed);
    repetition_of_load();
    return;
  }
  const std::vector<TurningPoint> &rest = outside.residue();
  for (std::size_t i = 1; i < rest.size(); ++i)
    cycles.push_back(cycle_between(rest[i - 1], rest[i], 0.5));
}

std::vector<Cycle> count_cycles(const Eigen::VectorXd &history, const LoadSequence &load)
{
  require_valid(load, history.size());
  std::vector<Cycle> cycles;
  count_cycles(history.data(), load, cycles);
  return cycles;
}

Eigen::VectorXd extremes_between_samples(const Eigen::VectorXd &history, const LoadSequence &load)
{
  Eigen::VectorXd between = history;
  const auto      bend    = [&](std::int64_t i) { return history[i + 1] - 2. * history[i] + history[i - 1]; };
  for (const LoadBlock &block : load.blocks)
    for (std::int64_t i = block.first + 2; i < block.end - 2; ++i)
    {
      const double before = history[i] - history[i - 1], after = history[i + 1] - history[i], own = bend(i);
      const auto alike = [&](double other) { return 0.5 * own * own <= own * other && own * other <= 2. * own * own; };
      if (before * after <= 0. && own != 0. && alike(bend(i - 1)) && alike(bend(i + 1)))
        between[i] -= (before + after) * (before + after) / (8. * own);
    }
  return between;
}

RangeMeanMatrix range_mean_matrix(const std::vector<Cycle> &cycles, const std::vector<double> &weights, int classes)
{
  assert(classes > 0 && (weights.empty() || weights.size() == cycles.size()));
  RangeMeanMatrix matrix;
  matrix.counts = matrix.damage = Eigen::MatrixXd::Zero(classes, classes);
  if (cycles.empty())
    return matrix;
  const auto by_mean           = [](const Cycle &a, const Cycle &b) { return a.mean < b.mean; };
  const auto by_range          = [](const Cycle &a, const Cycle &b) { return a.range < b.range; };
  const auto [lowest, highest] = std::minmax_element(cycles.begin(), cycles.end(), by_mean);
  matrix.range_width           = std::max_element(cycles.begin(), cycles.end(), by_range)->range / classes;
  matrix.mean_begin            = lowest->mean;
  matrix.mean_width            = (highest->mean - lowest->mean) / classes;
  const auto place             = [&](double distance, double width)
  { return width > 0. ? std::min(classes - 1, static_cast<int>(distance / width)) : 0; };
  for (std::size_t k = 0; k < cycles.size(); ++k)
  {
    const int i = place(cycles[k].range, matrix.range_width);
    const int j = place(cycles[k].mean - matrix.mean_begin, matrix.mean_width);
    matrix.counts(i, j) += cycles[k].count;
    matrix.damage(i, j) += weights.empty() ? 0. : weights[k];
  }
  return matrix;
}

} // namespace gestell::apps
