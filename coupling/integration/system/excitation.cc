#include "coupling/integration/system/excitation.h"

#include <cmath>
#include <stdexcept>
#include <string>

namespace gestell::coupling
{

void Excitation::add_harmonic(int coordinate, double omega, double cosine, double sine)
{
  if (!(omega > 0.))
    throw std::invalid_argument("Excitation: circular frequency " + std::to_string(omega) +
                                " rad/s; it must be positive; give a constant load as such");
  Harmonic *same = nullptr;
  for (Harmonic &harmonic : harmonics_)
    if (harmonic.omega == omega)
      same = &harmonic;
  if (!same)
    same = &harmonics_.emplace_back(Harmonic{omega, {}});
  for (Entry &entry : same->load)
    if (entry.coordinate == coordinate)
    {
      entry.cosine += cosine;
      entry.sine += sine;
      return;
    }
  same->load.push_back({coordinate, cosine, sine});
}

void Excitation::at(double t, Eigen::VectorXd &f) const
{
  f = constant_;
  for (const Harmonic &harmonic : harmonics_)
  {
    const double c = std::cos(harmonic.omega * t), s = std::sin(harmonic.omega * t);
    for (const Entry &entry : harmonic.load)
      f[entry.coordinate] += entry.cosine * c + entry.sine * s;
  }
  if (rest_)
    rest_(t, f);
}

} // namespace gestell::coupling
