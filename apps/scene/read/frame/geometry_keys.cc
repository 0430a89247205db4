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
  return key::named("surface", "a single surface").by_default("`surfaces`");
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
      key::number("size", kind::length, "element size; not for `.msh` and `.inp`").above_zero(),
      key::number("max_cells", kind::number, "largest number of elements; a larger mesh is an error")
          .above_zero()
          .by_default(&Mesh::max_cells),
      key::number("gap", kind::length,
                  "largest distance of faces or nodes that are joined. Solids of STEP, BREP and `.geo` files are "
                  "joined where they touch, as if welded (scripts need no `BooleanFragments`; physical groups are "
                  "kept); with `gap = \"0.1 mm\"` also up to this distance, which must be less than a third of their "
                  "mean thickness (2 volume / surface). In meshes, nodes within this distance are merged")
          .from_zero()
          .by_default(&Mesh::gap),
      key::plain("bodies", Key::Form::whole,
                 "expected number of separate bodies. Any other number is an error that names the nearest faces of the "
                 "bodies and their distance")
          .by_default(&Mesh::bodies),
      key::number("defeature", kind::length,
                  "size below which bores, fillets, chamfers and edges are removed from STEP and BREP models, if the "
                  "neighbouring faces can close the gap; a note lists the removed features")
          .from_zero()
          .by_default(&Mesh::defeature),
      key::choice("overlaps", {"refused", "once"}, true,
                  "overlapping solids are an error, because the common volume would count twice; `\"once\"` assigns it "
                  "to the first solid in the file")
          .into(&Mesh::overlaps, {fem::Overlaps::refused, fem::Overlaps::once}),
      key::choice(
          "plates", {"tetrahedra", "swept"}, true,
          "`\"swept\"` meshes walls in hexahedra through the thickness, narrow along the edges of plates and up to "
          "`size` wide between them: thin plates need far fewer DOFs for the same accuracy. Tubes, pins and "
          "other "
          "solids with a constant section are swept along their axis. Each remaining solid becomes tetrahedra, and a "
          "note "
          "gives the reason. Meshes that do not match are tied at their common faces")
          .into(&Mesh::plates, {fem::Plates::tetrahedra, fem::Plates::swept}),
      key::plain("layers", Key::Form::whole, "smallest number of elements through a swept plate")
          .by_default(&Mesh::layers),
      key::truth(
          "curved", false,
          "curved sides of tetrahedra, which follow bores, fillets and other curved faces: the shape error "
          "falls with the fourth power of the element size, that of straight sides with the second. Sides that "
          "would fold an element are straightened, and a note is printed. Quadratic tetrahedral meshes from files keep "
          "their sides. Hexahedra have straight edges: `true` is an error, and a note gives the distance of the "
          "mid-side nodes of quadratic ones from these edges")
          .into(&Mesh::curved)};
  return keys;
}

const std::vector<Key> &prestress_keys()
{
  static const std::vector<Key> keys = {
      key::truth("gravity", false, "include the weight of the frame and its masses (`gravity` of the scene)"),
      key::composed(
          "loads", Key::Form::tables, kind::number,
          {one_surface_key(), surfaces_key("loaded surfaces"),
           key::vector("force", kind::force, "total force, spread evenly over the area").by_default("[0, 0, 0]"),
           key::number("pressure", kind::pressure, "pressure into the solid").by_default(0.)},
          "static loads on surfaces, `[{ surface = \"table\", force = [0, 0, \"-500 kN\"] }]`; they keep their "
          "direction")
          .by_default("none"),
      key::number("factor", kind::number, "factor of these loads").by_default(1.)};
  return keys;
}

const std::vector<Key> &frame_keys()
{
  static const std::vector<Key> keys = {
      key::plain("cad", Key::Form::file,
                 "CAD or mesh file, `.step .stp .brep .geo .msh .inp`, see [geometry](frame.md#geometry-and-meshes)")
          .by_default("`reduced`, or [matrices](#frame-given-by-matrices)"),
      key::number("unit", kind::length, "length unit of a file without one, `\"1 mm\"`")
          .above_zero()
          .by_default("that of the file"),
      key::table("repair", {key::number("sew", kind::length, "largest distance of edges that are joined").above_zero()},
                 "`\"sew\"` joins edges of an open shell in a STEP or BREP file that are at most 0.05 mm apart; `{ sew "
                 "= \"0.2 mm\" }` sets another distance, less than a third of the thinnest wall. A line of the run "
                 "lists the joined edges")
          .also({Key::Form::text})
          .by_default("none"),
      key::map("dimensions", kind::length, {},
               "new values of variables of a script (`.geo`): `{ web_plate = \"70 mm\" }` replaces the value of its "
               "first line `web_plate = ...;`. A [study](../study.md) may vary them")
          .by_default("those of the script"),
      key::map("mesh", kind::length, mesh_keys(),
               "`{ size = \"60 mm\", \"crown bearing *\" = \"30 mm\" }`: element size, in general and on surfaces by "
               "patterns of their names (`*` any characters, `?` one). A `.geo` that ends with `Mesh 3;` makes its own "
               "mesh, in any kernel of gmsh; it receives `size` as `Mesh.MeshSizeMax`. Elements are tetrahedra; such "
               "scripts, `.msh` and `.inp` may also contain hexahedra and prisms: one layer of hexahedra suffices for "
               "a thin wall")
          .by_default("required, except for `.msh` and `.inp`"),
      material_key().by_default("`\"steel\"`"),
      key::plain(
          "materials", Key::Form::map,
          "materials of single solids by name or pattern; the last match applies: `{ \"crown\" = \"cast "
          "iron\", \"column *\" = \"steel\" }`; all other solids have `material`. `gestell mesh` lists the names")
          .by_default("none"),
      key::table("damping", damping_keys(),
                 "modal damping ratios, `{ ratio = 0.02 }`, or Rayleigh damping by the ratios at two frequencies, `{ "
                 "rayleigh = [{ frequency = \"20 Hz\", ratio = 0.01 }, { frequency = \"500 Hz\", ratio = 0.02 }] }`")
          .by_default("none"),
      key::table(
          "prestress", prestress_keys(),
          "static loads whose stresses stiffen or soften the frame (geometric stiffness), `{ gravity = true }`: in "
          "modes, runs and steady states. `gestell modes`, the report and `summary.json` give the buckling factor; a "
          "factor of 1 or less is "
          "an error. Displacements count from the frame under `loads`; its weight also acts as a load of the run")
          .by_default("none"),
      key::plain("parts", Key::Form::whole,
                 "number of parts, at most 64, into which the mesh is cut; they are reduced in separate processes and "
                 "joined: less memory for large frames of plates and beams, [see there](parts.md#one-mesh-in-parts). "
                 "`\"auto\"`: the fewest parts with about the least estimated memory")
          .also({Key::Form::text})
          .by_default(1.),
      key::plain("reduced", Key::Form::file,
                 "reduced frame written by `gestell reduce SCENE -o DIR` (`DIR/reduced_frame.h5`), with its interfaces")
          .by_default("`cad`"),
      key::table("surface", {}, "`[frame.surface.NAME]`").by_default(""),
      key::table("support", {}, "`[frame.support.NAME]`").by_default(""),
      key::table("interface", {}, "`[frame.interface.NAME]`, at least one").by_default(""),
      key::table("mass", {}, "`[frame.mass.NAME]`").by_default(""),
      key::table("cut", {}, "`[frame.cut.NAME]`").by_default(""),
      key::table("stress_point", {}, "`[frame.stress_point.NAME]`").by_default("")};
  return keys;
}

const std::vector<Key> &surface_keys()
{
  static const std::vector<Key> keys = {
      key::table("cylinder",
                 {key::direction("axis", "direction of its axis"),
                  key::vector("through", kind::length, "point of the axis"),
                  key::number("radius", kind::length, "radius").above_zero()},
                 "faces on a cylinder")
          .by_default("any"),
      key::table("plane",
                 {key::direction("normal", "outward"), key::vector("through", kind::length, "point of the plane")},
                 "faces in a plane")
          .by_default("any"),
      key::table("box",
                 {key::vector("min", kind::length, "lower corner"), key::vector("max", kind::length, "upper corner")},
                 "faces inside a box")
          .by_default("any"),
      key::plain("group", Key::Form::text,
                 "name, layer or colour (`\"#ff8000\"`) of the face in a STEP file; physical group of a mesh; node set "
                 "or surface of an `.inp`, in capitals")
          .by_default("any"),
      key::plain("faces", Key::Form::whole,
                 "expected number of CAD faces, or `\"any\"`; faces that share an edge, such as the halves of a bore, "
                 "may count as one")
          .also({Key::Form::text})
          .by_default(1.),
      key::number("tolerance", kind::length, "tolerance of these conditions")
          .above_zero()
          .by_default("1e-4 of the diagonal of the model")};
  return keys;
}

const std::vector<Key> &support_keys()
{
  static const std::vector<Key> keys = {
      one_surface_key(), surfaces_key("names of the supported surfaces"),
      key::truth("clamped", false, "rigid support of all displacements"),
      key::plain("directions", Key::Form::texts,
                 "directions of a clamped support: `[\"x\", \"z\"]` fixes only these displacements")
          .by_default("all"),
      key::table(
          "foundation",
          {per_direction_key("stiffness", kind::stiffness, "total stiffness over the surface, or `[x, y, z]`"),
           per_direction_key("damping", kind::damping, "total damping over the surface, or `[x, y, z]`"),
           per_direction_key("stiffness_per_area", kind::bedding, "stiffness per area, instead of the total"),
           per_direction_key("damping_per_area", kind::damping_per_area, "damping per area, instead of the total"),
           key::composed("axes", Key::Form::matrix, kind::number, {},
                         "directions of the three values: these two and the perpendicular one")
               .by_default("x, y and z")},
          "elastic support, springs and dampers to the ground: `stiffness`, `damping` or both, totals over the "
          "surface, one number for all directions or `[x, y, z]`. `stiffness_per_area = \"40 N/mm^3\"` and "
          "`damping_per_area` are multiplied by the area. With `axes = [[1, 1, 0], [-1, 1, 0]]` the three values act "
          "along these two directions and the perpendicular one")
          .by_default("`clamped`")};
  return keys;
}

const std::vector<Key> &interface_keys()
{
  static const std::vector<Key> keys = {
      one_surface_key(),
      surfaces_key("names of its surfaces; a surface can be part of only one interface"),
      key::choice(
          "coupling", {"rigid", "average", "point", "node", "flexible"}, true,
          "`\"rigid\"`: the surface moves as a rigid body with the node. `\"average\"`: the node has the area-weighted "
          "mean motion of the surface, which stays flexible; forces are distributed over it. `\"point\"`: the node is "
          "the point of the surface nearest to `position`, with the mean motion of the surrounding triangles (a note "
          "is printed if it is far from `position`). `\"node\"`: the mesh vertex nearest to `position`, on its "
          "surfaces or, without any, on the whole skin, with three displacements and no rotation. `\"flexible\"`: "
          "plane face in a weld or contact of [parts](parts.md) that deforms in polynomials relative to the node")
          .into(&fem::InterfaceSpecification::coupling,
                {fem::InterfaceCoupling::rigid, fem::InterfaceCoupling::average, fem::InterfaceCoupling::point,
                 fem::InterfaceCoupling::node, fem::InterfaceCoupling::flexible}),
      key::vector("position", kind::length, "position of the node; required for `\"point\"` and `\"node\"`")
          .by_default("centroid")
          .into(&fem::InterfaceSpecification::position),
      key::number("radius", kind::length, "radius around a `\"point\"` within which triangles are averaged")
          .from_zero()
          .by_default("triangles at the nearest vertex"),
      key::plain("degree", Key::Form::whole,
                 "degree of the polynomials of a flexible face, from 1 to 8: 3 (degree + 1)(degree + 2)/2 DOFs")
          .by_default(4.)};
  return keys;
}

const std::vector<Key> &cut_keys()
{
  static const std::vector<Key> keys = {
      key::table("plane",
                 {key::direction("normal", "normal n, along which the force is measured"),
                  key::vector("through", kind::length, "point of the plane")},
                 "plane that cuts the frame"),
      key::direction("first", "direction of the first axis e1, made perpendicular to n; the second is n x e1")
          .by_default("the global axis that follows the one nearest to n, in the order x, y, z, x"),
      key::vector("about", kind::length, "point about which moments are taken").by_default("centroid of the section")};
  return keys;
}

const std::vector<Key> &stress_point_keys()
{
  static const std::vector<Key> keys = {
      key::vector("at", kind::length,
                  "point on the surface; the nearest one of the mesh is used and its distance printed"),
      key::direction("along",
                     "direction n of the signal `normal`, the normal stress n . sigma n, such as across a weld")
          .by_default("no `normal`")};
  return keys;
}

const std::vector<Key> &attached_mass_keys()
{
  static const std::vector<Key> keys = {
      key::number("mass", kind::mass, "mass of the body").above_zero().into(&fem::AttachedMass::mass),
      key::vector("inertia", kind::inertia,
                  "inertia about the centre of mass: moments `[Jx, Jy, Jz]` or the tensor, as for a rigid "
                  "[body](bodies.md#bodies)")
          .also({Key::Form::matrix})
          .by_default("0"),
      principal_axes_key(),
      key::named("on", "interface whose node carries the mass, such as `\"crown\"`").by_default("`surfaces`"),
      one_surface_key(),
      surfaces_key("surfaces to which the mass is fastened; not those of an interface"),
      key::choice("coupling", {"rigid", "average"}, true, "attachment to these surfaces")
          .into(&fem::AttachedMass::coupling, {fem::InterfaceCoupling::rigid, fem::InterfaceCoupling::average}),
      key::vector("position", kind::length, "centre of mass; its offset from the node is part of the model")
          .by_default("node of the interface, centroid of the surfaces")
          .into(&fem::AttachedMass::centre)};
  return keys;
}

} // namespace gestell::apps
