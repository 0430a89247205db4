#include "apps/scene/read/frame/geometry_keys.h"

#include "apps/scene/read/frame/read_damping.h"
#include "apps/scene/read/read_material.h"
#include "apps/scene/read/read_tensor.h"
#include "fem/values/frame_specification.h"

namespace gestell::apps
{
namespace
{

Key one_surface_key()
{
  return key::named("surface", "the only one of them").by_default("`surfaces`");
}

Key surfaces_key(const std::string &meaning)
{
  return key::plain("surfaces", Key::Form::texts, meaning).by_default("`surface`");
}

} // namespace

const std::vector<Key> &mesh_keys()
{
  using Mesh = fem::MeshOptions;

  static const std::vector<Key> keys = {
      key::number("size", kind::length, "of elements; a `.msh` or `.inp` needs none").above_zero(),
      key::number("max_cells", kind::number, "refuses a mesh of more elements")
          .above_zero()
          .by_default(&Mesh::max_cells),
      key::number("gap", kind::length,
                  "solids of STEP, BREP and `.geo` files are joined where they touch, as if welded (a script needs no "
                  "`BooleanFragments`, its physical groups stay); with `gap = \"0.1 mm\"` also where they are that far "
                  "apart, which must be less than a third of the mean thickness of these solids (2 volume / surface: "
                  "of a plate its thickness). In meshes nodes that close are taken for one")
          .from_zero()
          .by_default(&Mesh::gap),
      key::plain("bodies", Key::Form::whole,
                 "number of bodies expected that do not hang together. With another number the frame is refused, and "
                 "the message names the nearest faces of the bodies and their distance")
          .by_default(&Mesh::bodies),
      key::number("defeature", kind::length,
                  "bores, fillets, chamfers and edges smaller than this length are removed from STEP and BREP models, "
                  "where the neighbouring faces can close the gap; a note lists what was removed")
          .from_zero()
          .by_default(&Mesh::defeature),
      key::choice("overlaps", {"refused", "once"}, true,
                  "solids that overlap would count twice what they share; `\"once\"` gives it to the solid that comes "
                  "first in the file")
          .into(&Mesh::overlaps, {fem::Overlaps::refused, fem::Overlaps::once}),
      key::choice(
          "plates", {"tetrahedra", "swept"}, true,
          "`\"swept\"` meshes walls in hexahedra through the thickness, narrow along the edges of plates and up to "
          "`size` wide between them: thin plates need far fewer coordinates for the same accuracy. Tubes, pins and "
          "other "
          "solids with a constant section are swept along their axis. Each remaining solid becomes tetrahedra, and a "
          "note "
          "gives the reason. Meshes that do not match are tied at their common faces")
          .into(&Mesh::plates, {fem::Plates::tetrahedra, fem::Plates::swept}),
      key::plain("layers", Key::Form::whole, "of cells through a swept plate, at least").by_default(&Mesh::layers),
      key::truth(
          "curved", false,
          "sides of tetrahedra follow bores, fillets and other curved faces, so that coarse elements keep the "
          "shape, off by the fourth power of their size where straight sides are off by the second. Where that "
          "would fold a cell its sides are straightened, and a note says so. Quadratic meshes of tetrahedra keep the "
          "sides they come with. Hexahedra have straight edges: `true` is refused, and a note says how far "
          "the middle nodes of quadratic ones lie off these edges")
          .into(&Mesh::curved)};
  return keys;
}

const std::vector<Key> &frame_keys()
{
  static const std::vector<Key> keys = {
      key::plain("cad", Key::Form::file,
                 "`.step .stp .brep .geo .msh .inp`, see [geometry](frame.md#geometry-and-meshes)")
          .by_default("`reduced`, or [matrices](#frame-given-by-matrices)"),
      key::number("unit", kind::length, "length unit of a file that has none, `\"1 mm\"`")
          .above_zero()
          .by_default("of the file"),
      key::table("repair",
                 {key::number("sew", kind::length, "the largest distance of edges that are joined").above_zero()},
                 "`\"sew\"` joins the edges of an open shell in a STEP or BREP file where they are at most 0.05 mm "
                 "apart, `{ sew = \"0.2 mm\" }` another distance, less than a third of the thinnest wall; a line says "
                 "what was sewn")
          .also({Key::Form::text})
          .by_default("none"),
      key::map("dimensions", kind::length, {},
               "of a script (`.geo`): lengths and numbers in place of those that it assigns, `{ web_plate = \"70 mm\" "
               "}` for its "
               "first line `web_plate = ...;`. A [study](../study.md) may vary them")
          .by_default("those of the script"),
      key::map(
          "mesh", kind::length, mesh_keys(),
          "`{ size = \"60 mm\", \"crown bearing *\" = \"30 mm\" }`: size of elements, and at surfaces by patterns of "
          "their names (`*` any letters, `?` one). A `.geo` that ends with `Mesh 3;` meshes by itself, in any kernel "
          "of gmsh: `size` reaches it as `Mesh.MeshSizeMax`. Cells are tetrahedra or, in such scripts and in `.msh` "
          "and `.inp`, hexahedra and prisms too: one layer of hexahedra carries a thin wall")
          .by_default("demanded, but of `.msh` and `.inp`"),
      material_key().by_default("`\"steel\"`"),
      key::plain(
          "materials", Key::Form::map,
          "materials of single solids, by their names or patterns of names, of which the last that fits counts: `{ "
          "\"crown\" = \"cast iron\", \"column *\" = \"steel\" }`; all others are of `material`. `gestell mesh` lists "
          "the names")
          .by_default("none"),
      key::table("damping", damping_keys(),
                 "by ratios of the modes, `{ ratio = 0.02 }`, or after Rayleigh by the ratios at two frequencies, `{ "
                 "rayleigh = [{ frequency = \"20 Hz\", ratio = 0.01 }, { frequency = \"500 Hz\", ratio = 0.02 }] }`")
          .by_default("none"),
      key::plain(
          "parts", Key::Form::whole,
          "number of parts that the mesh is cut into, which are reduced in processes of their own and joined: less "
          "memory for large frames of plates and beams, [see there](parts.md#one-mesh-in-parts); `\"auto\"`: "
          "the fewest that need about the least memory by estimate; at most 64")
          .also({Key::Form::text})
          .by_default(1.),
      key::plain("reduced", Key::Form::file,
                 "a reduced frame written by `gestell reduce SCENE -o DIR` (`DIR/reduced_frame.h5`); its interfaces "
                 "are known when it is read")
          .by_default("`cad`"),
      key::table("surface", {}, "`[frame.surface.NAME]`").by_default(""),
      key::table("support", {}, "`[frame.support.NAME]`").by_default(""),
      key::table("interface", {}, "`[frame.interface.NAME]`, one at least").by_default(""),
      key::table("mass", {}, "`[frame.mass.NAME]`").by_default(""),
      key::table("cut", {}, "`[frame.cut.NAME]`").by_default("")};
  return keys;
}

const std::vector<Key> &surface_keys()
{
  static const std::vector<Key> keys = {
      key::table("cylinder",
                 {key::direction("axis", "direction of its axis"),
                  key::vector("through", kind::length, "a point of the axis"),
                  key::number("radius", kind::length, "radius").above_zero()},
                 "faces on a cylinder")
          .by_default("any"),
      key::table("plane",
                 {key::direction("normal", "outward"), key::vector("through", kind::length, "a point of the plane")},
                 "faces in a plane")
          .by_default("any"),
      key::table("box",
                 {key::vector("min", kind::length, "lower corner"), key::vector("max", kind::length, "upper corner")},
                 "faces inside a box")
          .by_default("any"),
      key::plain("group", Key::Form::text,
                 "name of the face in a STEP file, its layer, its colour as `\"#ff8000\"`; physical group of a mesh; "
                 "set of nodes or surface of an `.inp`, in capitals")
          .by_default("any"),
      key::plain("faces", Key::Form::whole,
                 "number of CAD faces expected, or `\"any\"`; faces that share an edge, as the halves of a bore, may "
                 "count as one")
          .also({Key::Form::text})
          .by_default(1.),
      key::number("tolerance", kind::length, "within which these hold")
          .above_zero()
          .by_default("1e-4 of the model's diagonal")};
  return keys;
}

const std::vector<Key> &support_keys()
{
  static const std::vector<Key> keys = {
      one_surface_key(), surfaces_key("names of surfaces that are held"), key::truth("clamped", false, "held rigidly"),
      key::plain("directions", Key::Form::texts,
                 "of a clamped support: `[\"x\", \"z\"]` holds these displacements only")
          .by_default("all"),
      key::table("foundation",
                 {per_direction_key("stiffness", kind::stiffness, "total over the surface, or `[x, y, z]`"),
                  per_direction_key("damping", kind::damping, "total over the surface, or `[x, y, z]`"),
                  per_direction_key("stiffness_per_area", kind::bedding, "in place of the total"),
                  per_direction_key("damping_per_area", kind::damping_per_area, "in place of the total"),
                  key::composed("axes", Key::Form::matrix, kind::number, {},
                                "the three values act along these two directions and the third at right angles to both")
                      .by_default("x, y and z")},
                 "springs and dampers to the ground: `stiffness`, `damping` or both, totals over the surface, one "
                 "number for all directions or `[x, y, z]`. `stiffness_per_area = \"40 N/mm^3\"` and "
                 "`damping_per_area` instead are multiplied by the area. `axes = [[1, 1, 0], [-1, 1, 0]]`: the three "
                 "values act along these two directions and the third at right angles to both")
          .by_default("`clamped`")};
  return keys;
}

const std::vector<Key> &interface_keys()
{
  static const std::vector<Key> keys = {
      one_surface_key(),
      surfaces_key("names of its surfaces; a surface belongs to one interface at most"),
      key::choice(
          "coupling", {"rigid", "average", "point", "node", "flexible"}, true,
          "`\"rigid\"`: the surface moves as a rigid body with the node; `\"average\"`: the node moves as the mean of "
          "the surface, weighted by area, a force spreads over it and the surface stays flexible; `\"point\"`: the "
          "node is the point of the surface nearest to `position` and takes the mean motion of the triangles around it "
          "(a note says so if it is far from `position`); `\"node\"`: the corner of the mesh nearest to `position`, on "
          "its "
          "surfaces or, if it names none, on the whole skin, with its three displacements as they are and no rotation; "
          "`\"flexible\"`: a plane face in a weld or contact of [parts](parts.md), which moves with the node and "
          "deforms in "
          "polynomials")
          .into(&fem::InterfaceSpecification::coupling,
                {fem::InterfaceCoupling::rigid, fem::InterfaceCoupling::average, fem::InterfaceCoupling::point,
                 fem::InterfaceCoupling::node, fem::InterfaceCoupling::flexible}),
      key::vector("position", kind::length, "of the node; of a point and of `\"node\"` required")
          .by_default("centroid")
          .into(&fem::InterfaceSpecification::position),
      key::number("radius", kind::length, "of a point: triangles of the surface within it")
          .from_zero()
          .by_default("triangles that meet at the nearest corner"),
      key::plain("degree", Key::Form::whole,
                 "of the polynomials of a flexible face, from 1 to 8: 3 (degree + 1)(degree + 2)/2 coordinates")
          .by_default(4.)};
  return keys;
}

const std::vector<Key> &cut_keys()
{
  static const std::vector<Key> keys = {key::table("plane",
                                                   {key::direction("normal", "along which the force counts"),
                                                    key::vector("through", kind::length, "a point of the plane")},
                                                   "that cuts the frame")};
  return keys;
}

const std::vector<Key> &attached_mass_keys()
{
  static const std::vector<Key> keys = {
      key::number("mass", kind::mass, "of the body").above_zero().into(&fem::AttachedMass::mass),
      key::vector(
          "inertia", kind::inertia,
          "about its centre of mass: moments `[Jx, Jy, Jz]` or the tensor, as of a rigid [body](bodies.md#bodies)")
          .also({Key::Form::matrix})
          .by_default("0"),
      principal_axes_key(),
      key::named("on", "the interface whose node carries it, such as `\"crown\"`").by_default("`surfaces`"),
      one_surface_key(),
      surfaces_key("the surfaces it is fastened to, which belong to no interface"),
      key::choice("coupling", {"rigid", "average"}, true, "to these surfaces")
          .into(&fem::AttachedMass::coupling, {fem::InterfaceCoupling::rigid, fem::InterfaceCoupling::average}),
      key::vector("position", kind::length,
                  "its centre of mass; where it lies off the node, the lever arm is part of the model")
          .by_default("node of the interface, centroid of the surfaces")
          .into(&fem::AttachedMass::centre)};
  return keys;
}

} // namespace gestell::apps
