#include "coupling/reduction/fixed_modes.h"

#include "coupling/dense_modes.h"
#include "coupling/integration/second_order_system.h"
#include "coupling/reduction/rounded.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace gestell::coupling
{

namespace
{

using Eigen::MatrixXd;

constexpr int    dense_limit   = 600;                       // internal coordinates that are solved densely
constexpr double most_growth   = 1e9;                       // of rounding in the inertia: beyond it a pivot met zero
constexpr double places[]      = {0.5, 0.3, 0.7, 0.2, 0.8}; // in a gap, tried in turn
constexpr int    largest_block = 200;                       // with which missing modes are looked for
constexpr double two_pi        = 6.283185307179586;

/// All modes of the held frame, densely: for few coordinates, where Krylov spaces run out of room.
LowestModes dense_fixed_modes(const fem::FrameMatrices &frame, const std::vector<int> &q2)
{
  const MatrixXd M = frame.M, C = frame.C;
  const auto     modes = dense_modes(C(q2, q2), M(q2, q2));
  LowestModes all{modes.omega, MatrixXd::Zero(M.rows(), modes.omega.size()), Eigen::VectorXd::Zero(modes.omega.size())};
  all.V(q2, Eigen::all) = modes.V;
  return all;
}

} // namespace

FixedModes::FixedModes(HeldFrame &held, const fem::FrameMatrices &frame, const std::vector<int> &q1,
                       const BlockLanczos::Options &options)
    : held_(held), frame_(frame), options_(options)
{
  for (int i = 0; i < int(frame.M.rows()); ++i)
    if (!std::binary_search(q1.begin(), q1.end(), i))
      q2_.push_back(i);
  dense_ = int(q2_.size()) <= dense_limit;
}

void FixedModes::find(int count)
{
  wanted_ = count;
  if (dense_)
  {
    if (found_.omega.size() == 0)
      found_ = dense_fixed_modes(frame_, q2_);
    if (found_.omega.size() < count)
      throw ConvergenceFailure("fixed-interface modes: " + std::to_string(count) +
                               " asked for, but the mass matrix of the internal coordinates has rank " +
                               std::to_string(found_.omega.size()) + "; ask for fewer modes");
  }
  else if (search_)
    search_->find(count);
  else if (count > 0)
  {
    held_.restore();
    look_for({}, count, options_.block);
  }
}

LowestModes FixedModes::lowest(int count)
{
  if (count == 0)
    return {Eigen::VectorXd(0), MatrixXd(frame_.M.rows(), 0), Eigen::VectorXd(0)};
  if (search_)
    return search_->modes(count);
  return {found_.omega.head(count), found_.V.leftCols(count), found_.bound.head(count)};
}

void FixedModes::finish()
{
  held_.release(); // before the modes are made of the space
  if (search_)
  {
    gap_   = search_->gap_above(wanted_);
    found_ = search_->modes(gap_.below);
    search_.reset();
  }
  else if (wanted_ == 0)
    found_ = lowest(0);
}

void FixedModes::look_for(const LowestModes &known, int count, int block)
{
  BlockLanczos::Options options = options_;
  options.block                 = block;
  search_                       = held_.search(options, known);
  search_->find(count);
}

/// Each search is by larger blocks, which find frequencies that are repeated more often.
void FixedModes::look_for_missing(LowestModes known, int count, double omega)
{
  held_.restore();
  const auto missing = [&] { return count - int((known.omega.array() < omega).count()); };
  for (int block = std::max(options_.block, missing()); missing() > 0; block *= 2)
  {
    if (block > largest_block)
      throw ConvergenceFailure("fixed-interface modes: " + std::to_string(missing()) + " of " + std::to_string(count) +
                               " below " + rounded(omega / two_pi) +
                               " Hz are not found; ask for another number of modes");
    look_for(known, count, block);
    known = search_->modes(count);
  }
}

Inertia FixedModes::count_in_gap(double &omega) const
{
  Inertia best{0, INFINITY};
  for (const double place : places)
  {
    const double shift = std::isfinite(gap_.high) ? gap_.low + place * (gap_.high - gap_.low) : gap_.low * (1. + place);
    const auto   inertia = held_.below(shift);
    if (inertia.growth < best.growth)
      best = inertia, omega = shift;
    if (best.growth < most_growth)
      return best;
  }
  throw ConvergenceFailure("fixed-interface modes: the number below " + rounded(omega / two_pi) +
                           " Hz cannot be told, for rounding in the factor grows " + rounded(best.growth) +
                           "-fold; ask for another number of modes");
}

bool FixedModes::confirm()
{
  if (dense_ || wanted_ == 0)
    return true;
  double     omega   = 0.;
  const auto inertia = count_in_gap(omega);
  if (inertia.negative < gap_.below)
    throw ConvergenceFailure("fixed-interface modes: " + std::to_string(gap_.below) + " are found below " +
                             rounded(omega / two_pi) + " Hz, but the inertia of the stiffness tells of " +
                             std::to_string(inertia.negative) + " only; M and C must be symmetric");
  if (inertia.negative == gap_.below)
  {
    if (statement_.empty())
      statement_ = "modes: the inertia of C - omega^2 M at " + rounded(omega / two_pi) + " Hz tells of " +
                   std::to_string(gap_.below) + " fixed-interface modes below it, and as many are found";
    return true;
  }
  look_for_missing(std::move(found_), inertia.negative, omega);
  statement_ = "modes: " + std::to_string(inertia.negative - gap_.below) + " of " + std::to_string(inertia.negative) +
               " fixed-interface modes below " + rounded(omega / two_pi) +
               " Hz were passed over at first, found missing by the inertia of C - omega^2 M, and searched for";
  return false;
}

} // namespace gestell::coupling
