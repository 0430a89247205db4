#include "coupling/sensitivity/growth.h"

#include "coupling/sensitivity/output_derivatives.h"
#include "fem/values/number_text.h"

#include <algorithm>
#include <cmath>

namespace gestell::coupling
{

namespace
{
using Eigen::Index;
using Eigen::VectorXd;

} // namespace

Growth::Growth(const Machine &machine, const VectorXd &mass, const Trajectory &trajectory,
               const std::vector<ParameterTwins> &twins)
    : machine_(machine), twins_(twins), root_mass_(mass.cwiseMax(0.).cwiseSqrt()), largest_(twins.size())
{
  const auto      &pieces = trajectory.pieces();
  const double     begin = pieces.front().nodes.front().t, end = pieces.back().nodes.back().t;
  constexpr double early = 0.1; // of the run: the reference for growth is its first part
  first_                 = begin + early * (end - begin);
  VectorXd low = pieces.front().nodes.front().q, high = low;
  for (const SmoothPiece &piece : pieces)
    for (const MotionNode &node : piece.nodes)
    {
      low  = low.cwiseMin(node.q);
      high = high.cwiseMax(node.q);
    }
  way_ = high - low;
  way_.head(way_.size() - machine.model().n_mechanism()).setZero();
  const VectorXd   weights = root_mass_.cwiseProduct(way_);
  constexpr double at_rest = 1e-6; // of the largest momentum of a way: the coordinate does not move
  for (Index i = 0; i < way_.size(); ++i)
    if (weights[i] <= at_rest * weights.maxCoeff())
      way_[i] = 0.;
}

void Growth::look(double t, const Eigen::MatrixXd &s)
{
  for (std::size_t k = 0; k < largest_.size(); ++k)
  {
    const VectorXd weights = root_mass_.cwiseProduct(s.col(Index(k)).cwiseAbs());
    for (Index i = 0; i < way_.size(); ++i)
    {
      // of the largest entry of the derivative: smaller entries do not show its growth
      constexpr double takes_part = 1e-3;
      if (!(way_[i] > 0.) || !(weights[i] > takes_part * weights.maxCoeff()))
        continue;
      Largest     &most  = largest_[k];
      const double ratio = std::abs(s(i, Index(k)) * twins_[k].value) / way_[i];
      if (t <= first_)
        most.early = std::max(most.early, ratio);
      if (ratio > most.ratio)
      {
        most.ratio      = ratio;
        most.t          = t;
        most.coordinate = i;
      }
    }
  }
}

std::vector<std::string> Growth::warnings() const
{
  std::vector<std::string> sentences;
  for (std::size_t k = 0; k < largest_.size(); ++k)
  {
    const Largest   &most    = largest_[k];
    constexpr double too_far = 10.; // ways that a coordinate is moved by one percent
    if (!(one_percent * most.ratio > too_far))
      continue;
    const std::string grown    = most.early > 0. ? "; since the first tenth of the run it grew by a factor of " +
                                                    short_text(most.ratio / most.early, 2)
                                                 : "";
    constexpr double  believed = 0.1; // share of the range up to which first order is accepted
    sentences.push_back(
        "1 % of " + twins_[k].key + " would move " + machine_.coordinate_name(int(most.coordinate)) + " at t = " +
        short_text(most.t) + " s by " + short_text(one_percent * most.ratio, 2) + " times its total travel" + grown +
        ": the motion is chaotic or unstable, and derivatives by this parameter are valid for changes below " +
        short_text(100. * believed / most.ratio, 2) + " % only");
  }
  return sentences;
}

} // namespace gestell::coupling
