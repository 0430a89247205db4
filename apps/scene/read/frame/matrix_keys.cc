#include "apps/scene/read/frame/matrix_keys.h"

namespace gestell::apps
{
namespace
{

Key matrix_key(const std::string &name, const Kind &kind, const std::string &meaning)
{
  return key::composed(name, Key::Form::matrix, kind, {}, meaning).also({Key::Form::file});
}

Key row_key(const std::string &name, const Kind &kind, const std::string &meaning)
{
  return key::composed(name, Key::Form::numbers, kind, {}, meaning);
}

const std::vector<Key> &matrix_name_keys()
{
  const auto name = [](const std::string &key, const std::string &usual)
  { return key::plain(key, Key::Form::text, "its name in the file").by_default(usual); };
  static const std::vector<Key> keys = {name("mass", "MAAX, MASS, or the only one with M"),
                                        name("stiffness", "KAAX, STIFFNESS, or the only one with K"),
                                        name("damping", "BAAX, DAMPING, or the only one with B")};
  return keys;
}

Key direction_key(const std::string &name)
{
  return key::table(name, matrix_output_keys(), "of the force along " + name).by_default("the rows are of all of it");
}

} // namespace

const std::vector<Key> &matrix_frame_keys()
{
  const std::string form = "n x n, symmetric, each entry once; a file in MatrixMarket or PETSc's binary format, or "
                           "of [another program](#matrices-of-nastran-calculix-and-ansys), told apart by content";
  static const std::vector<Key> keys = {
      matrix_key("mass", kind::mass_entry,
                 form + ". Rows without mass, such as rotations of lumped masses, may be if stiffness holds them"),
      matrix_key("stiffness", kind::stiffness_entry, form),
      matrix_key("damping", kind::damping_entry,
                 "likewise; or a table `{ ratio }` or `{ rayleigh }` as of a frame from CAD")
          .also({Key::Form::file, Key::Form::table})
          .by_default("none"),
      matrix_key("translations", kind::number,
                 "n x 3: q of a unit translation of the whole frame in x, y, z; needed for gravity")
          .by_default("from interfaces and nodes, if every row belongs to one"),
      key::number("total_mass", kind::mass,
                  "what the frame is said to weigh: clamped parts are not in `mass`. Where neither this nor the "
                  "`translations` of all rows are known, the mass is said to be unknown, and effective masses count "
                  "the rows of interfaces and nodes alone")
          .above_zero()
          .by_default("by `mass` and `translations`"),
      key::table("matrix_names", matrix_name_keys(), "of a file that holds several, such as Nastran's")
          .by_default("by what they are called"),
      key::plain(
          "rows", Key::Form::file,
          "what the rows of matrices are that count them: node and direction, a `.dof` of CalculiX or a `.mapping` "
          "of Ansys")
          .by_default("of the matrices, if their format tells"),
      key::table("file_units", file_unit_keys(),
                 "that the files of another program count in: matrices whose rows are known, and places of nodes; "
                 "matrices written in the scene are in SI")
          .by_default("kg, m, s, N"),
      key::plain("nodes", Key::Form::file,
                 "table of nodes (CSV): interfaces, positions, and what pictures show; or, where rows are known, the "
                 "model of another program (GRID, *NODE, NBLOCK)")
          .by_default("GRID cards beside the matrices"),
      key::plain("triangles", Key::Form::file,
                 "table of three or four nodes in each line (from 1, in the order of `nodes`), for pictures")
          .by_default("none"),
      key::plain("node_displacements", Key::Form::file,
                 "3 N x n: displacements x, y, z of the N nodes as rows on q, where they are not rows of q themselves")
          .by_default("by the rows of `nodes`"),
      key::table("interface", {}, "`[frame.interface.NAME]`, one at least, or a node with a name").by_default(""),
      key::table("support", {}, "`[frame.support.NAME]`").by_default(""),
      key::table("cut", {}, "`[frame.cut.NAME]`").by_default("")};
  return keys;
}

const std::vector<Key> &file_unit_keys()
{
  static const std::vector<Key> keys = {
      key::number("length", kind::length, "`\"1 mm\"`").above_zero().by_default(1.),
      key::number("mass", kind::mass, "`\"1 t\"`").above_zero().by_default(1.),
      key::number("time", kind::time, "`\"1 ms\"`").above_zero().by_default(1.),
      key::number("force", kind::force, "where it is not that of the others: N beside kg and mm")
          .above_zero()
          .by_default("mass length / time^2")};
  return keys;
}

const std::vector<Key> &matrix_interface_keys()
{
  static const std::vector<Key> keys = {
      key::plain("rows", Key::Form::map,
                 "`{ \"-uz\" = 1 }`: row 1 of q is the displacement *against* z. "
                 "Rows count from 1; motions without a row are held")
          .by_default("of `node` or the node at `position`, where rows are known"),
      key::plain("node", Key::Form::whole,
                 "its number in the other program; all its rows are motions of the "
                 "interface")
          .by_default("by `rows` or `position`"),
      key::vector("position", kind::length, "of the node").by_default("of the table of nodes, else [0, 0, 0]")};
  return keys;
}

const std::vector<Key> &matrix_output_keys()
{
  static const std::vector<Key> keys = {
      row_key("stiffness_row", kind::stiffness_entry,
              "n numbers: the signal is stiffness_row q + damping_row q' + acceleration_row `gravity` in N. Signs are "
              "yours: by custom cuts count tension, supports pressure positive"),
      row_key("damping_row", kind::damping_entry, "n numbers").by_default("0"),
      row_key("acceleration_row", kind::mass_entry, "three numbers").by_default("0")};
  return keys;
}

const std::vector<Key> &matrix_support_keys()
{
  static const std::vector<Key> keys =
      joined({{direction_key("x"), direction_key("y"), direction_key("z")}, matrix_output_keys()});
  return keys;
}

} // namespace gestell::apps
