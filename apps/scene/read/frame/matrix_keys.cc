#include "apps/scene/read/frame/matrix_keys.h"

#include "fem/values/frame_specification.h"
#include "fem/values/stress_recovery.h"

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
  { return key::plain(key, Key::Form::text, "name of the matrix in the file").by_default(usual); };
  static const std::vector<Key> keys = {name("mass", "MAAX, MASS, or the only name with M"),
                                        name("stiffness", "KAAX, STIFFNESS, or the only name with K"),
                                        name("damping", "BAAX, DAMPING, or the only name with B")};
  return keys;
}

} // namespace

const std::vector<Key> &matrix_frame_keys()
{
  const std::string form = "n x n, symmetric, each entry once; a file in MatrixMarket or PETSc's binary format, or of "
                           "[another program](#matrices-of-nastran-calculix-and-ansys), recognised by content";
  static const std::vector<Key> keys = {
      matrix_key("mass", kind::mass_entry,
                 form + ". Rows without mass, such as rotations of lumped masses, need stiffness"),
      matrix_key("stiffness", kind::stiffness_entry, form),
      matrix_key("damping", kind::damping_entry,
                 "damping matrix, in the same forms; or a table `{ ratio }`, `{ modes }` or `{ rayleigh }` as "
                 "for a frame from CAD")
          .also({Key::Form::file, Key::Form::table})
          .by_default("none"),
      matrix_key("translations", kind::number,
                 "n x 3: q for a unit translation of the whole frame in x, y, z; required for gravity")
          .by_default("from interfaces and nodes, if they include every row"),
      key::number("total_mass", kind::mass,
                  "total mass of the frame, including clamped parts, which are not in `mass`. If neither this nor the "
                  "`translations` of all rows are known, the mass is reported as unknown, and effective masses include "
                  "only the rows of interfaces and nodes")
          .above_zero()
          .by_default("from `mass` and `translations`"),
      key::table("matrix_names", matrix_name_keys(),
                 "names of matrices in a file with several, such as that of Nastran")
          .by_default("by their usual names"),
      key::plain("rows", Key::Form::file,
                 "meaning (node and direction) of numbered rows: a `.dof` of CalculiX or a `.mapping` of Ansys")
          .by_default("from the matrices, if their format contains it"),
      key::table("file_units", file_unit_keys(),
                 "units of files from another program (matrices with known rows, node positions); matrices in the "
                 "scene are in SI units")
          .by_default("kg, m, s, N"),
      key::plain("nodes", Key::Form::file,
                 "table of nodes (CSV) with interfaces and positions, also for pictures; a model file of another "
                 "program (GRID, *NODE, NBLOCK) is also accepted if the nodes of the rows are known")
          .by_default("GRID cards in the files of the matrices"),
      key::plain("triangles", Key::Form::file,
                 "table with three or four nodes per line (numbered from 1 in the order of `nodes`), for pictures")
          .by_default("none"),
      key::plain("node_displacements", Key::Form::file,
                 "3 N x n: rows that give the displacements x, y, z of the N nodes from q, if these are not rows of q "
                 "themselves")
          .by_default("from the rows of `nodes`"),
      key::table("interface", {}, "`[frame.interface.NAME]`, at least one, or a named node").by_default(""),
      key::table("support", {}, "`[frame.support.NAME]`").by_default(""),
      key::table("cut", {}, "`[frame.cut.NAME]`").by_default(""),
      key::table("stress", {}, "`[frame.stress.NAME]`").by_default("")};
  return keys;
}

const std::vector<Key> &file_unit_keys()
{
  static const std::vector<Key> keys = {
      key::number("length", kind::length, "`\"1 mm\"`").above_zero().by_default(1.),
      key::number("mass", kind::mass, "`\"1 t\"`").above_zero().by_default(1.),
      key::number("time", kind::time, "`\"1 ms\"`").above_zero().by_default(1.),
      key::number("force", kind::force, "unit of force, if it is not consistent with the others: N with kg and mm")
          .above_zero()
          .by_default("mass length / time^2")};
  return keys;
}

const std::vector<Key> &matrix_interface_keys()
{
  static const std::vector<Key> keys = {
      key::plain("rows", Key::Form::map,
                 "rows of q: `{ \"-uz\" = 1 }` means that row 1 is the displacement *against* z. Rows are numbered "
                 "from 1; DOFs without a row are fixed")
          .by_default("those of `node` or of the node at `position`, if rows are known"),
      key::plain("node", Key::Form::whole,
                 "node number in the other program; all its rows become DOFs of the interface")
          .by_default("by `rows` or `position`"),
      key::vector("position", kind::length, "position of the node")
          .by_default("that of the table of nodes, else [0, 0, 0]")};
  return keys;
}

const std::vector<Key> &matrix_output_keys()
{
  static const std::vector<Key> keys = {
      row_key(
          "stiffness_row", kind::stiffness_entry,
          "n numbers: the signal is stiffness_row q + damping_row q' + inertia_row q'' + acceleration_row `gravity` "
          "in N. You choose the signs: usually tension is positive in cuts, pressure in supports"),
      row_key("damping_row", kind::damping_entry, "n numbers").by_default("0"),
      row_key("inertia_row", kind::mass_entry, "n numbers").by_default("0"),
      row_key("acceleration_row", kind::mass_entry, "three numbers").by_default("0")};
  return keys;
}

const std::vector<OutputFamily> &output_families()
{
  static const std::vector<OutputFamily> families = []
  {
    std::vector<OutputFamily> all = {
        {"cut", {}, {}}, {"support", {{"x", "N"}, {"y", "N"}, {"z", "N"}}, {}}, {"stress", {}, {}}};
    for (std::size_t i = 1; i < fem::section_components.size(); ++i)
      all[0].components.emplace_back(fem::section_components[i][0] + 1,
                                     fem::section_components[i][1]); // without the dot
    for (const char *component : fem::stress_names)
      all[2].components.emplace_back(component, "Pa");
    all[2].components.emplace_back("normal", "Pa");
    for (auto &[family, components, keys] : all)
    {
      for (const auto &[name, unit] : components)
        keys.push_back(key::table(name, matrix_output_keys(), "rows of the component " + name + " [" + unit + "]")
                           .by_default("none"));
      keys = joined({keys, matrix_output_keys()});
    }
    return all;
  }();
  return families;
}

} // namespace gestell::apps
