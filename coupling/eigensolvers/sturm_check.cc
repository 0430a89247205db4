#include "coupling/eigensolvers/sturm_check.h"

#include "coupling/integration/system/convergence_failure.h"
#include "fem/values/number_text.h"
#include "fem/values/two_pi.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace gestell::coupling
{

namespace
{

using Eigen::MatrixXd;

} // namespace

Eigen::VectorXd moved_by_rounding(const Eigen::MatrixXd &V, const Eigen::VectorXd &stiffness)
{
  return std::numeric_limits<double>::epsilon() * V.cwiseAbs2().transpose() * stiffness;
}

double largest_growth(const Eigen::VectorXd &omega, const Eigen::VectorXd &moved, double next, double shift)
{
  const Eigen::VectorXd distance = shift * shift - omega.array().square();
  const double          above    = next * next - shift * shift;
  return std::min(distance.cwiseQuotient(moved).minCoeff(), above / moved.maxCoeff());
}

SturmCheckedModes::SturmCheckedModes(std::string kind, bool dense, const BlockLanczos::Options &options,
                                     Eigen::VectorXd stiffness)
    : kind_(std::move(kind)), options_(options), dense_(dense), stiffness_(std::move(stiffness))
{
}

void SturmCheckedModes::find(int count)
{
  wanted_ = count;
  if (dense_)
  {
    if (found_.omega.size() == 0)
      found_ = all();
    if (found_.omega.size() < count)
      throw ConvergenceFailure(kind_ + ": only " + std::to_string(found_.omega.size()) +
                               " exist, because the mass matrix has no higher rank, but " + std::to_string(count) +
                               " are requested; set their number (reduction.modes) to that or less");
  }
  else if (search_)
    search_->find(count);
  else if (count > 0)
  {
    restore();
    look_for({}, count, options_.block);
  }
}

LowestModes SturmCheckedModes::lowest(int count)
{
  if (count == 0)
    return {Eigen::VectorXd(0), MatrixXd(n(), 0), Eigen::VectorXd(0)};
  if (search_)
    return search_->modes(count);
  return {found_.omega.head(count), found_.V.leftCols(count), found_.bound.head(count)};
}

LowestModes SturmCheckedModes::find_all(int count)
{
  // of finding modes that were missing: one suffices, unless a search misses some again
  constexpr int most_rounds = 4;
  for (int round = 0; round < most_rounds; ++round)
  {
    find(count);
    finish();
    if (confirm())
      return {found_.omega.head(count), found_.V.leftCols(count), found_.bound.head(count)};
  }
  throw ConvergenceFailure(kind_ + ": in " + std::to_string(most_rounds) +
                           " rounds some were missing each time; request another number of modes");
}

void SturmCheckedModes::finish()
{
  release(); // before the modes are made of the space
  if (wanted_ == 0)
  {
    search_.reset();
    found_ = lowest(0);
  }
  else if (search_)
  {
    gap_   = search_->gap_above(wanted_);
    found_ = search_->modes(gap_.below);
    search_.reset();
    moved_ = moved_by_rounding(found_.V, stiffness_);
  }
}

void SturmCheckedModes::look_for(const LowestModes &known, int count, int block)
{
  BlockLanczos::Options options = options_;
  options.block                 = block;
  search_                       = search(options, known);
  search_->find(count);
}

/// Each search is by larger blocks, which find frequencies that are repeated more often.
void SturmCheckedModes::look_for_missing(int missing, int count, double omega)
{
  restore();
  LowestModes known = found_.V.size() > 0 ? std::move(found_) : LowestModes();
  for (int block = std::max(options_.block, missing); missing > 0; block *= 2)
  {
    constexpr int largest_block = 200; // largest block for missing modes: more are not an oversight
    if (block > largest_block)
      throw ConvergenceFailure(kind_ + ": " + std::to_string(missing) + " of " + std::to_string(count) + " below " +
                               rounded(omega / two_pi) + " Hz are not found; request another number of modes");
    look_for(known, count, block);
    known   = search_->modes(count);
    missing = count - int((known.omega.array() < omega).count());
  }
}

Inertia SturmCheckedModes::count_in_gap(double &omega)
{
  Inertia best{0, INFINITY};
  double  least = INFINITY; // growth over what is allowed
  // places in a gap, tried in this order: the middle is farthest from both modes
  constexpr double places[] = {0.5, 0.3, 0.7, 0.2, 0.8};
  for (const double place : places)
  {
    const double shift = std::isfinite(gap_.high) ? gap_.low + place * (gap_.high - gap_.low) : gap_.low * (1. + place);
    const auto   inertia = below(shift);
    const double share   = inertia.growth / largest_growth(found_.omega, moved_, gap_.high, shift);
    if (share < least)
      best = inertia, omega = shift, least = share;
    if (least < 1.)
      return best;
  }
  throw ConvergenceFailure(kind_ + ": the number below " + rounded(omega / two_pi) +
                           " Hz cannot be counted: rounding in the factor grows " + rounded(best.growth) + "-fold, " +
                           rounded(least) + " times the width of the gap there; request another number of modes");
}

bool SturmCheckedModes::confirm()
{
  if (dense_ || wanted_ == 0)
    return true;
  double     omega   = 0.;
  const auto inertia = count_in_gap(omega);
  if (inertia.negative < gap_.below)
    throw ConvergenceFailure(kind_ + ": " + std::to_string(gap_.below) + " are found below " + rounded(omega / two_pi) +
                             " Hz, but the inertia of the stiffness gives " + std::to_string(inertia.negative) +
                             " only; M and C must be symmetric");
  if (inertia.negative == gap_.below)
  {
    if (statement_.empty())
      statement_ = "modes: the inertia of C - omega^2 M at " + rounded(omega / two_pi) + " Hz gives " +
                   std::to_string(gap_.below) + " " + kind_ + " below it, and all of them are found";
    return true;
  }
  look_for_missing(inertia.negative - gap_.below, inertia.negative, omega);
  statement_ = "modes: " + std::to_string(inertia.negative - gap_.below) + " of " + std::to_string(inertia.negative) +
               " " + kind_ + " below " + rounded(omega / two_pi) +
               " Hz were missing at first (inertia of C - omega^2 M) and were found by a further search";
  return false;
}

} // namespace gestell::coupling
