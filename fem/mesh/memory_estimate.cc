#include "fem/mesh/memory_estimate.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace gestell::fem
{

double compactness(double volume, double skin_area)
{
  constexpr double of_sphere = 0.41; // 2 (4 pi / 3)^(2/3) / (4 pi)
  return skin_area > 0. ? std::min(2. * std::pow(volume, 2. / 3.) / skin_area, of_sphere) : of_sphere;
}

double reduction_memory(double n_coordinates, double kappa, double n_averaged)
{
  const double     n           = n_coordinates / 1e5;
  constexpr double gib         = 1024. * 1024. * 1024.; // byte
  constexpr double of_averaged = 5e4;                   // bytes for a node
  return (0.22 + 0.37 * n + 3.8 * kappa * n * std::cbrt(n)) * gib + of_averaged * n_averaged;
}

double prestress_memory(double n_coordinates)
{
  constexpr double bytes = 0.2 * 1024. * 1024. * 1024. / 1e5; // for a DOF
  return bytes * n_coordinates;
}

double nodes_on(double area, double size)
{
  return 2. * area / (std::sqrt(0.1875) * size * size); // of equilateral triangles
}

double coordinates_of(double n_tetrahedra)
{
  return 4.8 * n_tetrahedra;
}

void require_memory(const std::string &what, double needed, double available, const std::string &place,
                    const std::string &advice)
{
  if (needed > available)
    throw std::invalid_argument(place + ": " + what + "; mesh and reduction need about " + memory_text(needed) +
                                "; available are " + memory_text(available) + ". " + advice);
}

} // namespace gestell::fem
