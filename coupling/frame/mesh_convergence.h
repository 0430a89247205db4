#pragma once

#include "coupling/frame/reduced_frame.h"

#include <functional>
#include <string>
#include <vector>

namespace gestell::coupling
{

struct MeshConvergence;

struct ConvergenceOptions
{
  double tolerance       = 0.01; ///< relative error allowed in every quantity, > 0
  int    n_frequencies   = 4;    ///< number of lowest elastic modes included, >= 1
  bool   compliances     = true; ///< include those of all interfaces except point interfaces
  int    max_coordinates = 1000000;
  int    max_meshes      = 6;  ///< >= 2
  double memory          = 0.; ///< [byte] allowed for a mesh with its reduction; 0: the memory that is available

  /// Called after each mesh with the result so far, which an interrupted study keeps.
  std::function<void(const MeshConvergence &so_far)> after_mesh = {};
};

/// One of the meshes.
struct MeshLevel
{
  double size          = 0.; ///< [m] largest element size
  int    n_cells       = 0;
  int    n_coordinates = 0;
  double cpu_s         = 0.; ///< from the CAD model to the reduced frame
  // of each quantity
  std::vector<std::string> names; ///< "frequency 1", "compliance of engine"
  std::vector<double>      values;
  std::vector<double>      estimates; ///< relative error estimated from the stresses of this mesh alone
};

/// Retains the quantities common to all meshes, by name and in the order of the first: frames of different meshes may
/// have different numbers of modes.
/// @return the names removed.
std::vector<std::string> keep_common(std::vector<MeshLevel> &levels);

/// A frequency or a compliance over the meshes.
struct ConvergedQuantity
{
  std::string name;               ///< "frequency 1", "compliance of engine"
  std::string unit;               ///< "Hz", "m/N"
  double      limit       = 0.;   ///< extrapolated to elements of size zero
  double      uncertainty = 0.;   ///< of the limit, relative
  double      error       = 0.;   ///< of the last mesh's value, relative to the limit
  double      order       = 0.;   ///< k of  error ~ n^(-k)  in the number n of coordinates; NaN: not observed
  bool        regular     = true; ///< values approach the limit mesh by mesh, see Extrapolated
  int         n_meshes    = 0;    ///< used for the limit: one mesh alone is not sufficient
  double      bound() const { return (error < 0. ? -error : error) + uncertainty; }
};

struct MeshConvergence
{
  std::vector<MeshLevel>         levels;
  std::vector<ConvergedQuantity> quantities;
  bool                           converged = false; ///< every bound() is within the tolerance
  std::string                    stopped;           ///< reason if it is not
  std::vector<std::string>       left_out;          ///< quantities that some mesh does not have
  std::vector<std::string>       at_points;         ///< interfaces without a limit of the compliance, not included
  ReducedFrame                   frame;             ///< of the last mesh
};

} // namespace gestell::coupling
