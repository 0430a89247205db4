#pragma once

#include "fem/assembly/quadratic_mesh.h"

#include <Eigen/Core>

#include <array>
#include <memory>

namespace gestell::fem
{

/// Points of a cell.
enum class CellPoints
{
  rule,    ///< quadrature, exact for masses and stiffnesses of cells with parallel edges
  finer,   ///< exact for stiffnesses of cubic and quadratic functions there
  samples, ///< superconvergent stress points: Gauss points one order below full integration
  nodes
};

/// Shape functions N_a of a cell at some of its points.
struct PointValues
{
  Eigen::VectorXd weight; ///< [points] of the quadrature, one for nodes, times det(dx/dxi) [m^3]
  Eigen::MatrixXd N;      ///< [n x points]
  Eigen::MatrixXd dN;     ///< [n x 3 points] dN_a / dx_d [1/m] of point k in column 3 k + d
};

/// Quadratic functions of the cells of a mesh in space, by deal.II's FEValues: isoparametric, so that curved sides are
/// followed.  Refers to the mesh.
class CellValues
{
public:
  CellValues(const QuadraticMesh &mesh, CellPoints points);
  ~CellValues();

  /// Valid until the next call.
  const PointValues &of(int cell);

private:
  class NodalMapping;
  struct OfKind;
  const QuadraticMesh                   &mesh_;
  CellPoints                             points_;
  std::array<std::unique_ptr<OfKind>, 3> of_kind_;
};

} // namespace gestell::fem
