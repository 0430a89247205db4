#pragma once

#include "fem/geometry/cad_model.h"

#include <TopTools_DataMapOfShapeInteger.hxx>
#include <TopoDS_Shape.hxx>
#include <TopoDS_TShape.hxx>

#include <map>
#include <set>
#include <string>
#include <vector>

namespace gestell::fem
{

/// Attributes of a solid or a face in the file.
struct ShapeLabel
{
  std::string              name;         ///< "" for none
  std::vector<std::string> groups;       ///< layers and colours ("#ff8000") of a face
  std::string              material;     ///< of a solid, "" for none
  double                   density = 0.; ///< [kg/m^3], 0 for none
};

/// The shapes of a STEP or BREP file, in gmsh's unit.
struct CadShape
{
  TopoDS_Shape whole;
  /// Of solids and faces; all placements of a part share them.
  std::map<Handle(TopoDS_TShape), ShapeLabel> labels;
  int                                         n_described = 0; ///< solids of the file, closed or not
};

/// Solids and their faces by gmsh's tags.
struct TaggedShapes
{
  std::map<int, TopoDS_Shape>    solids, faces;
  TopTools_DataMapOfShapeInteger tags; ///< of both
};

/// The shapes of the model that is open in gmsh: model.shape, or for a script a copy, which gmsh exports through a
/// (temporary) file only.
TopoDS_Shape whole_shape(const CadModel &model);

/**
 * Pairs the solids of whole_shape() with those of gmsh, and their faces, by their order.
 *
 * @throws std::runtime_error if they differ in number, volume or area: no version of gmsh promises this order.
 */
TaggedShapes tagged_shapes(const CadModel &model);

/**
 * Tags of the degenerate edges of the model open in gmsh; these are points: the tip of a cone, the pole of a sphere.
 *
 * Such an edge has a line in the parameters of its face and no curve in space; OpenCASCADE marks it as degenerate.  Its
 * length is rounding (0 or 2e-14 m).
 */
std::set<int> degenerate_edges(const CadModel &model);

/// Imports a shape into gmsh, without change and beside its other contents.
/// @param gap  if > 0, gmsh moves vertices to the ends of their curves, as it does when it opens a BREP file or joins
///             solids across a gap
void give_to_gmsh(const TopoDS_Shape &shape, double gap = 0.);

/// Gives names, layers and colours of model.shape to the solids and faces of the model.
void apply_labels(CadModel &model);

} // namespace gestell::fem
