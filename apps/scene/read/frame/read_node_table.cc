#include "apps/scene/read/frame/read_node_table.h"

#include "apps/scene/file/csv_file.h"
#include "apps/scene/language/units.h"
#include "coupling/exchange/node_places.h"
#include "coupling/frame/matrix_file.h"
#include "fem/values/nearest_name.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>

namespace gestell::apps
{
namespace
{

const std::vector<std::string> columns{"name", "x", "y", "z", "ux", "uy", "uz", "rx", "ry", "rz", "node"};
constexpr std::size_t          first_position = 1, first_motion = 4, number_column = 10;
constexpr double               same_place = 1e-3; // of the extent of the nodes: Nastran's short fields pass

/// The index of each of `columns` in the table, and the unit of length of the positions.
struct Layout
{
  std::vector<std::optional<std::size_t>> column = std::vector<std::optional<std::size_t>>(columns.size());
  std::array<double, 3>                   unit;

  explicit Layout(double length) : unit{length, length, length} {}
};

/// "x [mm]" is the column x in millimetres.
void add_column(const CsvFile &table, std::size_t at, Layout &layout)
{
  const std::string &title   = table.head[at];
  const std::string  name    = title.substr(0, std::min(title.find('['), title.find(' ')));
  const auto         found   = std::find(columns.begin(), columns.end(), name);
  const auto         refused = [&](const std::string &what)
  { return std::invalid_argument(table.place(table.head_number) + "column '" + title + "' " + what); };
  if (found == columns.end())
    throw refused("is not known; valid: " + listed(columns));
  const auto index = std::size_t(found - columns.begin());
  if (layout.column[index])
    throw refused("is a duplicate");
  layout.column[index] = at;
  if (name.size() == title.size())
    return;
  const auto open = title.find('['), close = title.find(']');
  const auto unit = open < close ? units().find(title.substr(open + 1, close - open - 1)) : units().end();
  if (index < first_position || index >= first_motion || unit == units().end() ||
      unit->second.dimension != Dimension{1, 0, 0})
    throw refused("has no unit of length in brackets, such as 'x [mm]'; only x, y and z take one");
  layout.unit[index - first_position] = unit->second.value;
}

Layout layout_of(const CsvFile &table, double length)
{
  Layout layout(length);
  for (std::size_t at = 0; at < table.head.size(); ++at)
    add_column(table, at, layout);
  for (std::size_t d = first_position; d < first_motion; ++d)
    if (!layout.column[d])
      throw std::invalid_argument(
          table.place(table.head_number) + "has no column '" + columns[d] +
          "'; the first line must name the columns, such as: name, x [mm], y [mm], z [mm], ux, uy, uz");
  return layout;
}

/// In metres: a number that is finite in its unit may be none in metres.
void require_finite(const std::array<double, 3> &x, const std::string &place)
{
  if (!std::isfinite(x[0]) || !std::isfinite(x[1]) || !std::isfinite(x[2]))
    throw std::invalid_argument(place + "the position of the node overflows; check the value and its unit");
}

TableNode read_node(const CsvFile &table, const CsvFile::Line &line, const Layout &layout, Eigen::Index n)
{
  TableNode node;
  node.place = table.place(line.number);
  if (layout.column[0])
    node.motions.name = line.cells[*layout.column[0]];
  if (node.motions.name.find('.') != std::string::npos)
    throw std::invalid_argument(node.place + "name '" + node.motions.name + "': names must not contain dots");
  for (std::size_t d = 0; d < 3; ++d)
    node.motions.position[d] = layout.unit[d] * table.number(line, *layout.column[first_position + d]);
  require_finite(node.motions.position, node.place);
  for (std::size_t motion = 0; motion < 6; ++motion)
    if (const auto column = layout.column[first_motion + motion])
    {
      const int row = table.integer(line, *column);
      if (std::abs(row) > n)
        throw std::invalid_argument(node.place + "column '" + columns[first_motion + motion] + "': there is no row " +
                                    std::to_string(std::abs(row)) + "; the matrices have rows 1 to " +
                                    std::to_string(n));
      if (row == 0)
        continue;
      node.motions.coordinate[motion] = std::abs(row) - 1;
      node.motions.sign[motion]       = row < 0 ? -1. : 1.;
    }
  return node;
}

/// Place of the node of a number, or -1.
using NodeIndex = std::map<long, int>;

NodeIndex index_of(const std::vector<TableNode> &nodes)
{
  NodeIndex index;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    index.emplace(nodes[i].number > 0 ? nodes[i].number : long(i + 1), int(i));
  return index;
}

/// Three nodes or, of a quadrilateral, two times three.
void add_triangles(const CsvFile &table, const CsvFile::Line &line, const NodeIndex &nodes, fem::Picture &picture)
{
  std::vector<int> corner;
  for (std::size_t column = 0; column < line.cells.size(); ++column)
    if (column < 3 || !line.cells[column].empty())
    {
      const int  number = table.integer(line, column);
      const auto node   = nodes.find(number);
      if (node == nodes.end())
        throw std::invalid_argument(table.place(line.number) + "there is no node " + std::to_string(number) +
                                    "; the table of nodes has " + std::to_string(nodes.begin()->first) + " to " +
                                    std::to_string(nodes.rbegin()->first));
      corner.push_back(node->second);
    }
  for (std::size_t i = 2; i < corner.size(); ++i)
    picture.triangles.push_back({corner[0], corner[i - 1], corner[i]});
}

Eigen::SparseMatrix<double> displacements_by_rows(const std::vector<TableNode> &nodes, Eigen::Index n)
{
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    for (int d = 0; d < 3; ++d)
      if (nodes[i].motions.coordinate[d] >= 0)
        entries.emplace_back(int(3 * i) + d, nodes[i].motions.coordinate[d], nodes[i].motions.sign[d]);
  Eigen::SparseMatrix<double> A(Eigen::Index(3 * nodes.size()), n);
  A.setFromTriplets(entries.begin(), entries.end());
  return A;
}

/// The DOFs of each node, by node number; the rows of the matrices are known.
std::map<long, TableNode> nodes_of_rows(const std::vector<coupling::RowLabel> &rows)
{
  std::map<long, TableNode> nodes;
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (rows[i].component > 0)
    {
      TableNode &node                                             = nodes[rows[i].node];
      node.number                                                 = rows[i].node;
      node.motions.coordinate[std::size_t(rows[i].component - 1)] = int(i);
    }
  return nodes;
}

/// Lines of a table with a column `node`; nodes without rows do not count unless they have a name.
void place_by_numbers(const CsvFile &table, const Layout &layout, std::map<long, TableNode> &nodes,
                      coupling::NodePlaces &places)
{
  for (std::size_t motion = first_motion; motion < number_column; ++motion)
    if (layout.column[motion])
      throw std::invalid_argument(table.place(table.head_number) + "has both 'node' and '" + columns[motion] +
                                  "'; the rows of a node follow from its number, so remove the other column");
  for (const auto &line : table.lines)
  {
    TableNode  read   = read_node(table, line, layout, 0);
    const long number = table.integer(line, *layout.column[number_column]);
    const auto node   = nodes.find(number);
    if (node == nodes.end() && !read.motions.name.empty())
      throw std::invalid_argument(read.place + "node " + std::to_string(number) + " ('" + read.motions.name +
                                  "') has no row in the matrices");
    if (node == nodes.end())
      continue;
    if (!places.emplace(number, read.motions.position).second)
      throw std::invalid_argument(read.place + "node " + std::to_string(number) + " already exists");
    node->second.motions.name = read.motions.name;
    node->second.place        = read.place;
  }
}

/// Every node with rows needs a place, once some are given.
void require_places(const SceneTable &frame, const std::string &key, const std::map<long, TableNode> &nodes,
                    const coupling::NodePlaces &places)
{
  std::vector<long> without;
  for (const auto &[number, node] : nodes)
    if (places.count(number) == 0)
      without.push_back(number);
  if (!without.empty())
    throw frame.error(key, "has no position for " + std::to_string(without.size()) + " of the " +
                               std::to_string(nodes.size()) + " nodes in the matrices, such as node " +
                               std::to_string(without.front()) + "; does it belong to another model?");
}

coupling::ModelNodes model_nodes(const std::string &path, const std::map<long, TableNode> &nodes, double length,
                                 coupling::UnknownPlaces unknown)
{
  std::set<long> wanted;
  for (const auto &[number, node] : nodes)
    wanted.insert(number);
  coupling::ModelNodes model = coupling::read_model_nodes(path, wanted, unknown);
  for (auto &[number, x] : model.places)
  {
    for (double &coordinate : x)
      coordinate *= length;
    require_finite(x, path + ": node " + std::to_string(number) + ": ");
  }
  return model;
}

/// Largest distance of two positions along an axis, or a share of the largest distance from the origin if that is
/// larger: rounding of short fields grows with the size of the numbers.
double extent_of(const coupling::NodePlaces &places)
{
  double extent = 0., farthest = 0.;
  for (const auto &[number, x] : places)
    for (std::size_t d = 0; d < 3; ++d)
    {
      extent   = std::max(extent, std::abs(x[d] - places.begin()->second[d]));
      farthest = std::max(farthest, std::abs(x[d]));
    }
  constexpr double rounded_field = 1e-6; // of a number: long fields pass, short ones where nodes lie apart
  return std::max(extent, rounded_field / same_place * farthest);
}

/// A node that two files name has one place in both, to the digits of short fields, and one system of motions.
void require_same_nodes(const FrameNodes &nodes, const coupling::ModelNodes &model, const std::string &file)
{
  const double tolerance = same_place * std::max(extent_of(nodes.places), extent_of(model.places));
  for (const auto &[number, x] : model.places)
    if (const auto place = nodes.places.find(number); place != nodes.places.end())
      for (std::size_t d = 0; d < 3; ++d)
        if (std::abs(place->second[d] - x[d]) > tolerance)
          throw std::invalid_argument("node " + std::to_string(number) + " is at " +
                                      coupling::place_text(place->second) + ", but at " + coupling::place_text(x) +
                                      " in " + file + "; is one of the files of another model, or in other units?");
}

/// Checks the axes of nodes for which both files give them.
void require_same_axes(const FrameNodes &nodes, const coupling::ModelNodes &model, const std::string &file)
{
  const auto axes_in = [](const std::map<long, Eigen::Matrix3d> &axes, long number) -> Eigen::Matrix3d
  { return axes.count(number) > 0 ? axes.at(number) : Eigen::Matrix3d::Identity(); };
  constexpr double same_axes = 1e-4; // of unit vectors: Nastran's short fields pass
  for (const auto &[number, x] : model.places)
    if (nodes.places.count(number) > 0 &&
        (axes_in(nodes.axes, number) - axes_in(model.axes, number)).cwiseAbs().maxCoeff() > same_axes)
      throw std::invalid_argument("node " + std::to_string(number) + " has another displacement coordinate system in " +
                                  file + " (CD); keep one of them");
}

/// Reads `nodes`: a table, or the model of another program.
/// @return whether the file also gives axes
bool read_named_nodes(const std::string &path, double length, std::map<long, TableNode> &nodes, FrameNodes &found)
{
  if (coupling::has_node_places(path))
  {
    coupling::ModelNodes model = model_nodes(path, nodes, length, coupling::UnknownPlaces::refused);
    found.places               = std::move(model.places);
    found.axes                 = std::move(model.axes);
    return true;
  }
  const CsvFile table  = read_csv(path);
  const Layout  layout = layout_of(table, length);
  if (!layout.column[number_column])
    throw std::invalid_argument(table.place(table.head_number) +
                                "has no column 'node' with the node numbers that identify the rows");
  place_by_numbers(table, layout, nodes, found.places);
  return false;
}

/// Adds the axes of nodes in the matrix files and, if the scene has no `nodes`, their positions.
void join_models(const GivenMatrices &given, const std::map<long, TableNode> &nodes, bool has_table, bool tells_axes,
                 FrameNodes &found)
{
  const auto unknown = has_table ? coupling::UnknownPlaces::left_out : coupling::UnknownPlaces::refused;
  for (const std::string &file : given.models)
  {
    const coupling::ModelNodes model = model_nodes(file, nodes, given.length, unknown);
    require_same_nodes(found, model, file);
    if (tells_axes)
      require_same_axes(found, model, file);
    found.axes.insert(model.axes.begin(), model.axes.end());
    if (!has_table)
      found.places.insert(model.places.begin(), model.places.end());
    tells_axes = tells_axes || !has_table;
  }
}

/// Nodes of matrices whose rows are known.
FrameNodes read_known_nodes(const SceneTable &frame, const GivenMatrices &given)
{
  std::map<long, TableNode> nodes = nodes_of_rows(given.rows);
  FrameNodes                found;
  const bool                has_key = frame.has("nodes");
  const std::string         key     = has_key ? "nodes" : "stiffness";
  try
  {
    const bool tells_axes = has_key && read_named_nodes(frame.file("nodes"), given.length, nodes, found);
    join_models(given, nodes, has_key, tells_axes, found);
  }
  catch (const std::invalid_argument &e)
  {
    throw frame.error(key, e.what());
  }
  if (has_key || !given.models.empty())
    require_places(frame, key, nodes, found.places);
  for (auto &[number, node] : nodes)
  {
    if (!found.places.empty())
      node.motions.position = found.places.at(number);
    found.all.push_back(std::move(node));
  }
  return found;
}

} // namespace

FrameNodes read_frame_nodes(const SceneTable &frame, const GivenMatrices &given, Eigen::Index n)
{
  if (!given.rows.empty())
    return read_known_nodes(frame, given);
  FrameNodes nodes;
  if (!frame.has("nodes"))
    return nodes;
  const std::string path = frame.file("nodes");
  try
  {
    const CsvFile table  = read_csv(path);
    const Layout  layout = layout_of(table, given.length);
    if (layout.column[number_column])
      throw std::invalid_argument(table.place(table.head_number) +
                                  "has a column 'node', but the matrices do not define the nodes of their rows; add "
                                  "rows = the file that does (.dof, .mapping), or give the columns ux to rz");
    for (const auto &line : table.lines)
      nodes.all.push_back(read_node(table, line, layout, n));
  }
  catch (const std::invalid_argument &e)
  {
    throw frame.error("nodes", e.what());
  }
  return nodes;
}

fem::Picture read_node_picture(const SceneTable &frame, const FrameNodes &of_frame, Eigen::Index n)
{
  const bool are_placed               = of_frame.all.empty() || of_frame.all[0].number == 0 || !of_frame.places.empty();
  const std::vector<TableNode> &nodes = are_placed ? of_frame.all : std::vector<TableNode>{};
  const NodeIndex               numbers = index_of(nodes);
  fem::Picture                  picture;
  for (const std::string key : {"triangles", "node_displacements"})
    if (frame.has(key) && nodes.empty())
      throw frame.error(key, "refers to the nodes of a table; add nodes = \"nodes.csv\"");
  for (const TableNode &node : nodes)
    picture.points.push_back(node.motions.position);
  picture.displacement = displacements_by_rows(nodes, n);
  const auto placed    = [&frame](const std::string &key, auto read)
  {
    if (!frame.has(key))
      return;
    try
    {
      read(frame.file(key));
    }
    catch (const std::invalid_argument &e)
    {
      throw frame.error(key, e.what());
    }
  };
  placed("triangles",
         [&](const std::string &path)
         {
           const CsvFile table = read_csv(path);
           if (table.head.size() != 3 && table.head.size() != 4)
             throw std::invalid_argument(table.place(table.head_number) + "has " + std::to_string(table.head.size()) +
                                         " columns; a line has the numbers of three or four nodes");
           for (const auto &line : table.lines)
             add_triangles(table, line, numbers, picture);
         });
  placed("node_displacements",
         [&](const std::string &path)
         {
           picture.displacement = coupling::read_matrix_file(path, std::max(Eigen::Index(3 * nodes.size()), n));
           if (picture.displacement.rows() != Eigen::Index(3 * nodes.size()) || picture.displacement.cols() != n)
             throw std::invalid_argument(path + ": is " + std::to_string(picture.displacement.rows()) + " x " +
                                         std::to_string(picture.displacement.cols()) + ", but must be " +
                                         std::to_string(3 * nodes.size()) + " x " + std::to_string(n) +
                                         ": three rows for every node, one column for every row of the mass matrix");
         });
  return picture;
}

} // namespace gestell::apps
