#include "coupling/integration/system/excitation_on_grid.h"

#include <cmath>

namespace gestell::coupling
{

void ExcitationOnGrid::find(double t_0, double h, long k)
{
  if (excitation_.has_rest())
  {
    f_.resize(excitation_.constant().size());
    excitation_.at(t_0 + double(k) * h, f_);
    return;
  }
  const auto &harmonics = excitation_.harmonics();
  const auto  turns_at  = [&](double t, Turns &turns)
  {
    turns.resize(Eigen::Index(harmonics.size()), 2);
    for (Eigen::Index i = 0; i < turns.rows(); ++i)
      turns.row(i) << std::cos(harmonics[std::size_t(i)].omega * t), std::sin(harmonics[std::size_t(i)].omega * t);
  };
  if (h != h_ || steps_.empty())
  {
    steps_.resize(points);
    for (long j = 0; j < points; ++j)
      turns_at(double(j) * h, steps_[std::size_t(j)]);
    f_     = excitation_.constant();
    block_ = -1;
  }
  if (const long block = k / points; block != block_ || t_0 != t_0_ || h != h_)
  {
    turns_at(t_0 + double(block * points) * h, first_);
    now_.resizeLike(first_);
    block_ = block;
    t_0_   = t_0;
    h_     = h;
  }
  const Turns &step = steps_[std::size_t(k % points)];
  now_.col(0)       = first_.col(0) * step.col(0) - first_.col(1) * step.col(1);
  now_.col(1)       = first_.col(1) * step.col(0) + first_.col(0) * step.col(1);
  for (const auto &harmonic : harmonics)
    for (const Excitation::Entry &entry : harmonic.load)
      f_[entry.coordinate] = excitation_.constant()[entry.coordinate];
  for (std::size_t i = 0; i < harmonics.size(); ++i)
    for (const Excitation::Entry &entry : harmonics[i].load)
      f_[entry.coordinate] += entry.cosine * now_(Eigen::Index(i), 0) + entry.sine * now_(Eigen::Index(i), 1);
}

} // namespace gestell::coupling
