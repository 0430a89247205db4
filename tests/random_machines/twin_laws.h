#pragma once

#include "tests/random_machines/draft.h"
#include "tests/random_machines/twin.h"

namespace gestell::tests
{

/// A motion that laws act on, in the scene and in its twin.
struct TwinLink
{
  Link          link;
  Twin::Measure u;
  double        rest = 0.; ///< u as described
};

/// A smooth law of a random kind in both; switches of the time turn some off, and back on.
void add_twin_law(Draft &draft, Twin &twin, const TwinLink &on);
/// A motor or a drive on the link's shaft, in both.
void add_twin_drive(Draft &draft, Twin &twin, const TwinLink &on);
/// Spring and damper in both.
void add_twin_spring(Draft &draft, Twin &twin, const TwinLink &on, double stiffness, double damping_ratio);

/// A load along a direction that turns with its body: constant and a harmonic.
/// @param x, z  place of the load  @param phi  angle of its body about y
void add_twin_follower(Draft &draft, Twin &twin, const Scale &scale, const std::string &entries, Twin::Measure x,
                       Twin::Measure z, Twin::Measure phi);

/// f(t) of a prescribed motion of an angle, which is zero at first, and the table that says so.
struct Prescribed
{
  std::string   table;
  Twin::Measure f;
};
Prescribed prescribed_motion(Draft &draft, Twin &twin, const Scale &scale);

} // namespace gestell::tests
