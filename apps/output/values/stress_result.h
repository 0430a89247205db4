#pragma once

#include "coupling/frame/stress_field.h"

#include <Eigen/Core>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace gestell::apps
{

/// Disagreement of neighbouring elements below which a stress stands; above, the mesh is too coarse there.
constexpr double resolved_disagreement = 0.1;

/// A point of the skin and what it bears.
struct StressPlace
{
  Eigen::Vector3d             at;             ///< [m]
  double                      von_mises = 0.; ///< [Pa]
  coupling::PrincipalStresses principal;
  double                      disagreement = 0.; ///< see coupling::disagreement()
  std::string                 nearby;            ///< support or interface that holds the surface there rigid, or ""
};

template <class Visitor>
void describe(Visitor &v, const StressPlace &x)
{
  v("von_mises", x.von_mises, "Pa", "equivalent stress");
  v("at", x.at, "m", "place x, y, z");
  v("principal", x.principal.values, "Pa", "principal stresses, descending");
  v("first_direction", x.principal.first, "1", "unit vector of the first");
  v("disagreement", x.disagreement, "1", "of neighbouring cells, relative");
  v("beside", x.nearby, "", "support or interface that holds the surface rigid there; empty: none");
}

/// The stresses at one instant.
struct StressAt
{
  std::string                label; ///< why this instant: "largest F_P"; may be empty
  double                     t = 0.;
  coupling::StressField      field;
  Eigen::Matrix3Xd           displacement; // [3 x points] m
  std::optional<StressPlace> peak;         ///< largest away from rigid surfaces
  std::optional<StressPlace> beside_rigid; ///< largest beside them
};

template <class Visitor>
void describe(Visitor &v, const StressAt &x)
{
  v("label", x.label, "", "why this instant");
  v("t", x.t, "s", "instant");
  v.maybe(x.peak.has_value(), "largest", x.peak, "", "largest stress away from rigid surfaces");
  v.maybe(x.beside_rigid.has_value(), "beside_rigid", x.beside_rigid, "", "largest stress beside them");
}

/// Stresses of a run at the skin of its frame.
struct StressResult
{
  std::vector<Eigen::Vector3d>    points; ///< [m]
  std::vector<std::array<int, 3>> triangles;
  std::vector<StressAt>           instants;      ///< ascending in time
  int                             n_states = 0;  ///< among which the largest stress was looked for; 0: it was not
  double                          step     = 0.; ///< [s] between them
};

template <class Visitor>
void describe(Visitor &v, const StressResult &x)
{
  v("points", x.points.size(), "", "points of the skin");
  v("states", x.n_states, "", "states among which the largest stress was looked for");
  v("step", x.step, "s", "between these states");
  v("instants", x.instants, "", "in the order of time");
}

} // namespace gestell::apps
