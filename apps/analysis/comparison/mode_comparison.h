#pragma once

#include "coupling/modes/mode_comparison.h"
#include "coupling/modes/modes.h"

#include <string>
#include <vector>

namespace gestell::apps
{

/// A measure common to both machines.
struct SharedMeasure
{
  std::string path, unit; ///< "crank.angle", "rad"
};

/// One of two machines whose modes are compared.
struct ComparedModes
{
  std::string                 scene; ///< its name
  std::vector<coupling::Mode> modes;
  Eigen::MatrixXd             shapes; ///< [measures x modes] mass normalised
};

/// Modes of the scene and of another one, matched by shape.
struct ComparedShapes
{
  std::vector<SharedMeasure> measures;
  ComparedModes              a, b;
  coupling::ModeComparison   match;
};

/// A shared measure with its apparent mass.
struct ComparedMeasure
{
  SharedMeasure measure{};
  double        mass = 0.;
};

template <class Visitor>
void describe(Visitor &v, const ComparedMeasure &x)
{
  v("name", x.measure.path, "", "path of the measure");
  v("unit", x.measure.unit, "", "of the measure");
  v("apparent_mass", x.mass, "kg, kg m^2", "apparent mass of both machines along the measure");
}

/// A pair of modes with similar shapes.
struct ComparedPair
{
  int    a = 0, b = 0; ///< mode numbers, from 1
  double a_hz = 0., b_hz = 0., assurance = 0., a_seen = 0., b_seen = 0.;
};

template <class Visitor>
void describe(Visitor &v, const ComparedPair &x)
{
  v("mode", x.a, "", "number of the mode");
  v("frequency_hz", x.a_hz, "Hz", "frequency of the mode");
  v("other_mode", x.b, "", "number of the other scene's mode");
  v("other_frequency_hz", x.b_hz, "Hz", "frequency of the mode");
  v("mac", x.assurance, "1", "modal assurance criterion");
  v("seen", x.a_seen, "1", "observability of the mode by the measures");
  v("other_seen", x.b_seen, "1", "observability of the other mode by the measures");
}

template <class Visitor>
void describe(Visitor &v, const ComparedShapes &x)
{
  std::vector<ComparedMeasure> measures;
  for (std::size_t k = 0; k < x.measures.size(); ++k)
    measures.push_back({x.measures[k], x.match.mass[Eigen::Index(k)]});
  std::vector<ComparedPair> pairs;
  for (const coupling::ModePair &pair : x.match.pairs)
    pairs.push_back({pair.a + 1, pair.b + 1, x.a.modes[std::size_t(pair.a)].frequency_hz,
                     x.b.modes[std::size_t(pair.b)].frequency_hz, pair.assurance, x.match.seen_a[pair.a],
                     x.match.seen_b[pair.b]});
  v("other", x.b.scene, "", "name of the other scene");
  v("measures", measures, "", "measures that both machines have");
  v("pairs", pairs, "", "modes of similar shape");
}

template <class Visitor>
void describe_answer(Visitor &v, const ComparedShapes &x)
{
  v.maybe(true, "compared_modes", x, "", "modes compared with those of another scene, `--compare`");
}

} // namespace gestell::apps
