#include "fem/geometry/sewing.h"

#include "fem/values/message_text.h"

#include <BRepBuilderAPI_Sewing.hxx>
#include <BRepGProp.hxx>
#include <BRepLib.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <GProp_GProps.hxx>
#include <ShapeFix_Solid.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Iterator.hxx>
#include <TopoDS_Solid.hxx>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace gestell::fem
{

namespace
{

/// 2 A / P, for the side of a wall its thickness.
double narrowest_width(const TopoDS_Shape &shape)
{
  double smallest = INFINITY;
  for (TopExp_Explorer face(shape, TopAbs_FACE); face.More(); face.Next())
  {
    GProp_GProps area, perimeter;
    BRepGProp::SurfaceProperties(face.Current(), area);
    BRepGProp::LinearProperties(face.Current(), perimeter);
    smallest = std::min(smallest, 2. * std::abs(area.Mass()) / perimeter.Mass());
  }
  return smallest;
}

bool is_closed(const TopoDS_Shape &solid)
{
  for (TopExp_Explorer shell(solid, TopAbs_SHELL); shell.More(); shell.Next())
    if (!BRep_Tool::IsClosed(shell.Current()))
      return false;
  return true;
}

/// Sews open parts and puts all into one compound.
class ShellSewing
{
public:
  ShellSewing(CadShape &shape, double tolerance) : labels_(shape.labels), tolerance_(tolerance)
  {
    builder_.MakeCompound(whole_);
    TopoDS_Compound top;
    builder_.MakeCompound(top);
    builder_.Add(top, shape.whole);
    visit(top);
    if (!left_.empty())
    {
      const auto together = sewn(left_);
      n_open              = together->NbFreeEdges();
      take(together, left_, {});
    }
    if (n_edges > 0)
      shape.whole = whole_;
  }

  int n_edges = 0, n_faces = 0, n_solids = 0, n_open = 0;

private:
  Handle(BRepBuilderAPI_Sewing) sewn(const std::vector<TopoDS_Shape> &parts) const
  {
    Handle(BRepBuilderAPI_Sewing) sewing = new BRepBuilderAPI_Sewing(tolerance_);
    for (const TopoDS_Shape &part : parts)
      sewing->Add(part);
    sewing->Perform();
    return sewing;
  }

  /// An assembly, or a part, whose open shells and faces belong together.
  void visit(const TopoDS_Shape &compound)
  {
    std::vector<TopoDS_Shape> open;
    for (TopoDS_Iterator child(compound); child.More(); child.Next())
      if (child.Value().ShapeType() < TopAbs_SOLID)
        visit(child.Value());
      else if (child.Value().ShapeType() > TopAbs_SOLID)
        open.push_back(child.Value());
      else if (is_closed(child.Value()))
        builder_.Add(whole_, child.Value());
      else
        sew_part({child.Value()}, labels_[child.Value().TShape()]);
    if (!open.empty())
      sew_part(open, labels_[(open.size() == 1 ? open.front() : compound).TShape()]);
  }

  /// It waits for the others if it stays open.
  void sew_part(const std::vector<TopoDS_Shape> &part, const ShapeLabel &label)
  {
    const auto alone = sewn(part);
    if (alone->NbFreeEdges() > 0)
      left_.insert(left_.end(), part.begin(), part.end());
    else
      take(alone, part, label);
  }

  /// @param label  of a solid that comes out
  void take(const Handle(BRepBuilderAPI_Sewing) & sewing, const std::vector<TopoDS_Shape> &parts,
            const ShapeLabel &label)
  {
    n_edges += sewing->NbContigousEdges();
    for (const TopoDS_Shape &part : parts)
      for (TopExp_Explorer face(part, TopAbs_FACE); face.More(); face.Next())
        if (sewing->IsModifiedSubShape(face.Current()))
        {
          ++n_faces;
          labels_[sewing->ModifiedSubShape(face.Current()).TShape()] = labels_[face.Current().TShape()];
        }
    const TopoDS_Shape result = sewing->SewedShape();
    const bool         solid  = parts.front().ShapeType() == TopAbs_SOLID && is_closed(result); // it may have voids
    if (solid)
      add_solid(solid_of(result), label);
    for (TopExp_Explorer shell(result, TopAbs_SHELL); shell.More() && !solid; shell.Next())
      if (BRep_Tool::IsClosed(shell.Current()))
        add_solid(ShapeFix_Solid().SolidFromShell(TopoDS::Shell(shell.Current())), label);
      else
        builder_.Add(whole_, shell.Current());
    for (TopExp_Explorer face(result, TopAbs_FACE, TopAbs_SHELL); face.More(); face.Next())
      builder_.Add(whole_, face.Current());
  }

  void add_solid(const TopoDS_Shape &solid, const ShapeLabel &label)
  {
    builder_.Add(whole_, solid);
    labels_[solid.TShape()] = label;
    ++n_solids;
  }

  TopoDS_Solid solid_of(const TopoDS_Shape &shells) const
  {
    TopoDS_Solid solid;
    builder_.MakeSolid(solid);
    for (TopExp_Explorer shell(shells, TopAbs_SHELL); shell.More(); shell.Next())
      builder_.Add(solid, shell.Current());
    BRepLib::OrientClosedSolid(solid);
    return solid;
  }

  std::map<Handle(TopoDS_TShape), ShapeLabel> &labels_;
  double                                       tolerance_;
  BRep_Builder                                 builder_;
  TopoDS_Compound                              whole_;
  std::vector<TopoDS_Shape>                    left_; ///< open when sewn alone
};

} // namespace

std::string sew(CadShape &shape, const CadSource &source, double unit)
{
  constexpr double share_of_width = 1. / 3.; // see sewing.h
  const double     narrowest      = unit * narrowest_width(shape.whole);
  if (source.sew >= share_of_width * narrowest)
    throw std::invalid_argument(source.place + ": repair sews within " + text(1e3 * source.sew) + " mm, but " +
                                source.path + " has a face or wall of " + text(1e3 * narrowest) +
                                " mm; sew less than a third of that, such as repair = { sew = \"" +
                                text(0.25e3 * narrowest) + " mm\" }, or close the gap in the CAD program.");
  const ShellSewing seams(shape, source.sew / unit);
  const auto        counted = [](int n, const std::string &thing)
  { return std::to_string(n) + " " + thing + (n == 1 ? "" : "s"); };
  const std::string within = " within " + text(1e3 * source.sew) + " mm";
  if (seams.n_edges == 0)
    return "repair finds no edges to sew" + within;
  return "repair sews " + counted(seams.n_edges, "edge") + " of " + counted(seams.n_faces, "face") + within +
         ", closes " + counted(seams.n_solids, "solid") + ", and leaves " + counted(seams.n_open, "edge") + " open";
}

} // namespace gestell::fem
