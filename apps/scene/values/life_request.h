#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace gestell::apps
{

/// An S-N curve as a scene gives it: by a notch class, by points, or by the strength of unwelded material.
struct CurveRequest
{
  std::optional<double>              notch_class;             ///< range at 2e6 cycles in MPa, as standards print it
  std::string                        standard;                ///< of the class
  std::vector<std::array<double, 2>> points;                  ///< N, range [Pa]
  std::optional<double>              strength;                ///< R_m [Pa]
  std::string                        material;                ///< group of FKM
  double                             design_factor = 1.;      ///< K of FKM
  std::optional<double>              ratio;                   ///< R of the points
  std::optional<double>              slope;                   ///< of a class of EN 13001-3-1
  bool                               stress_relieved = false; ///< compressive parts of ranges count 60 %
  double                             damage_sum      = 1.;    ///< sum of n/N at failure
  double                             safety          = 1.;    ///< divides the ranges that the curve allows
  std::string                        place;
};

constexpr const char *skin_name = "skin"; ///< of what no weld names

/// A weld, or any part of the skin that is judged by its own stress.
struct WeldRequest
{
  std::string                          name;
  std::vector<std::string>             surfaces;       ///< one: its points; two: the points of both, a line
  std::optional<std::array<double, 3>> direction;      ///< unit vector across it
  bool                                 shear = false;  ///< shear stress along it, else normal stress across it
  std::optional<CurveRequest>          curve;          ///< none: that of [life]
  double                               thickness = 0.; ///< t [m] of the plate; 0: no extrapolation
  std::vector<double>                  distances;      ///< of the points of the extrapolation, in t
  std::string                          place;
};

/// A load of the collective: the run of another scene.
struct BlockRequest
{
  std::string file; ///< absolute path of the scene
  double      repetitions = 1.;
  std::string place;
};

/// [life]: what is asked about the fatigue of the frame.
struct LifeRequest
{
  CurveRequest              curve;
  std::string               mean_stress, miner, measure, residue;
  double                    repetitions = 1.; ///< of the run in a collective
  double                    strokes     = 1.; ///< that a run stands for
  double                    period      = 0.; ///< [s] of service that a run stands for; 0: its window
  double                    step        = 0.; ///< [s] between the states that are counted
  std::vector<WeldRequest>  welds;
  std::vector<BlockRequest> blocks;
  std::string               place;
};

} // namespace gestell::apps
