#pragma once

#include "coupling/frame/stress_field.h"

#include <Eigen/Core>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace gestell::apps
{

/// Limit of the disagreement between adjacent elements: above it the mesh is too coarse for the stress there.
constexpr double resolved_disagreement = 0.1;

/// A point of the skin and its stress.
struct StressPlace
{
  Eigen::Vector3d             at;             ///< [m]
  double                      von_mises = 0.; ///< [Pa]
  coupling::PrincipalStresses principal;
  double                      disagreement = 0.; ///< see coupling::disagreement()
  std::string                 nearby;            ///< support or interface that makes the surface there rigid, or ""
};

template <class Visitor>
void describe(Visitor &v, const StressPlace &x)
{
  v("von_mises", x.von_mises, "Pa", "equivalent stress");
  v("at", x.at, "m", "position x, y, z");
  v("principal", x.principal.values, "Pa", "principal stresses, descending");
  v("first_direction", x.principal.first, "1", "unit vector of the first");
  v("disagreement", x.disagreement, "1", "disagreement of neighbouring elements, relative");
  v("beside", x.nearby, "", "support or interface that makes the surface rigid there; empty: none");
}

/// The stresses at one instant.
struct StressAt
{
  std::string                label; ///< reason for this instant: "largest F_P"; may be empty
  double                     t = 0.;
  coupling::StressField      field;
  Eigen::Matrix3Xd           displacement; // [3 x points] m
  std::optional<StressPlace> peak;         ///< largest stress away from rigid surfaces
  std::optional<StressPlace> beside_rigid; ///< largest stress next to rigid surfaces
};

template <class Visitor>
void describe(Visitor &v, const StressAt &x)
{
  v("label", x.label, "", "reason for this instant");
  v("t", x.t, "s", "instant");
  v.maybe(x.peak.has_value(), "largest", x.peak, "", "largest stress away from rigid surfaces");
  v.maybe(x.beside_rigid.has_value(), "beside_rigid", x.beside_rigid, "", "largest stress next to rigid surfaces");
}

/// Stresses at the skin of the frame during a run.
struct StressResult
{
  std::vector<Eigen::Vector3d>    points; ///< [m]
  std::vector<std::array<int, 3>> triangles;
  std::vector<StressAt>           instants;      ///< ascending in time
  int                             n_states = 0;  ///< number of instants searched for the largest stress; 0: no search
  double                          step     = 0.; ///< [s] between them
};

template <class Visitor>
void describe(Visitor &v, const StressResult &x)
{
  v("points", x.points.size(), "", "points of the skin");
  v("states", x.n_states, "", "number of states searched for the largest stress");
  v("step", x.step, "s", "interval of these states");
  v("instants", x.instants, "", "in the order of time");
}

} // namespace gestell::apps
