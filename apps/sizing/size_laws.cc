#include "apps/sizing/size_laws.h"

#include <algorithm>
#include <cmath>

namespace gestell::apps
{

namespace
{

double power(double a, double b, double size_a, double size_b)
{
  return std::log(a / b) / std::log(size_a / size_b);
}

} // namespace

double largest(const std::vector<Shares> &outputs, double Shares::*cause)
{
  double most_of_all = 0.;
  for (const Shares &output : outputs)
    most_of_all = std::max(most_of_all, output.*cause);
  return most_of_all;
}

std::optional<MeshPoint> coarsest_within(double aim, std::vector<MeshPoint> points, const std::vector<Shares> &others,
                                         double coarsest)
{
  std::sort(points.begin(), points.end(), [](const MeshPoint &a, const MeshPoint &b) { return a.size < b.size; });
  const MeshPoint &best         = points.front();
  constexpr double apart        = 1.05; // ratio of sizes from which on two points show a law
  const auto       law          = std::find_if(points.begin(), points.end(),
                                               [&](const MeshPoint &other) { return other.size > apart * best.size; });
  constexpr double least_order  = 1.; // re-entrant edges leave about one
  constexpr double most_order   = 4.; // energies of quadratic elements
  constexpr double usual_order  = 3.; // between both, until two meshes show it
  constexpr double fewest       = 1.; // beams
  constexpr double most         = 3.; // solids
  constexpr double usual_growth = 2.; // walls
  // of the size of the finest point: three halvings; one where nothing is known
  constexpr double finest = 0.125, finest_of_one = 0.5;
  double           q = usual_order, r = usual_growth, least = finest_of_one;
  const double     error = largest(best.shares, &Shares::degree);
  if (law != points.end())
  {
    const double before = largest(law->shares, &Shares::degree);
    if (error > 0. && std::isfinite(error) && std::isfinite(before))
      q = std::clamp(power(before, error, law->size, best.size), least_order, most_order);
    r     = std::clamp(-power(law->coordinates, best.coordinates, law->size, best.size), fewest, most);
    least = finest;
  }
  const auto expected = [&](double ratio)
  {
    double all = 0.;
    for (std::size_t i = 0; i < others.size(); ++i)
      all = std::max(all, best.shares[i].sides + best.shares[i].degree * std::pow(ratio, q) + others[i].modes +
                              others[i].time);
    return all;
  };
  if (!(expected(0.) <= aim) && std::isfinite(error))
    return {};
  double           ratio    = coarsest / best.size;
  constexpr double unseen   = 1. / ratio_of_meshes; // next size where the error is not known
  constexpr int    halvings = 40;                   // to 2^-40 of the first range of ratios
  if (!std::isfinite(error))
    ratio = largest(best.shares, &Shares::sides) <= aim ? unseen : 0.;
  else if (expected(least) > aim)
    ratio = least;
  else if (expected(ratio) > aim)
    for (double low = least, high = ratio, k = 0; k < halvings; ++k)
      (expected(ratio = std::sqrt(low * high)) <= aim ? low : high) = ratio;
  if (!(ratio > 0.))
    return {};
  MeshPoint next;
  next.size                = ratio * best.size;
  next.coordinates         = best.coordinates * std::pow(ratio, -r);
  constexpr double of_work = 1.2; // power of the coordinates: sparse factors of solids of few cells
  next.cpu_s               = best.cpu_s * std::pow(ratio, -r * of_work);
  return next;
}

double truncation_power(bool recovered, bool superposed)
{
  if (superposed)
    return recovered ? 0.5 : 1.;
  return recovered ? 1.5 : 3.;
}

double truncation_factor(Eigen::VectorXd omega, int kept, double power)
{
  if (kept < 0 || kept >= omega.size())
    return 1.;
  std::sort(omega.begin(), omega.end());
  return 1. / (1. - std::pow(omega[kept] / omega[omega.size() - 1], power));
}

const std::vector<int> &mode_ladder()
{
  static const std::vector<int> numbers = {0, 2, 4, 6, 8, 12, 16, 24, 32, 48, 64, 96, 128, 192, 256};
  return numbers;
}

int modes_for(double aim, int modes, double share)
{
  const double wanted = std::isfinite(share) ? modes * std::sqrt(share / aim) : 2. * modes;
  for (const int number : mode_ladder())
    if (number > modes && number >= wanted)
      return number;
  return std::max(modes, mode_ladder().back());
}

} // namespace gestell::apps
