#include "apps/scene/read/frame/read_node_table.h"

#include "apps/scene/file/csv_file.h"
#include "apps/scene/language/units.h"
#include "coupling/frame/matrix_file.h"
#include "fem/values/nearest_name.h"

#include <algorithm>
#include <optional>

namespace gestell::apps
{
namespace
{

const std::vector<std::string> columns{"name", "x", "y", "z", "ux", "uy", "uz", "rx", "ry", "rz"};
constexpr std::size_t          first_position = 1, first_motion = 4;

/// Where each of `columns` stands in the table, and the length that positions are in.
struct Layout
{
  std::vector<std::optional<std::size_t>> column = std::vector<std::optional<std::size_t>>(columns.size());
  std::array<double, 3>                   unit{1., 1., 1.};
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
    throw refused("is there twice");
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

Layout layout_of(const CsvFile &table)
{
  Layout layout;
  for (std::size_t at = 0; at < table.head.size(); ++at)
    add_column(table, at, layout);
  for (std::size_t d = first_position; d < first_motion; ++d)
    if (!layout.column[d])
      throw std::invalid_argument(
          table.place(table.head_number) + "has no column '" + columns[d] +
          "'; the first line must name the columns, such as: name, x [mm], y [mm], z [mm], ux, uy, uz");
  return layout;
}

TableNode read_node(const CsvFile &table, const CsvFile::Line &line, const Layout &layout, Eigen::Index n)
{
  TableNode node;
  node.place = table.place(line.number);
  if (layout.column[0])
    node.motions.name = line.cells[*layout.column[0]];
  if (node.motions.name.find('.') != std::string::npos)
    throw std::invalid_argument(node.place + "name '" + node.motions.name + "': names have no dots");
  for (std::size_t d = 0; d < 3; ++d)
    node.motions.position[d] = layout.unit[d] * table.number(line, *layout.column[first_position + d]);
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

/// Three nodes or, of a quadrilateral, two times three.
void add_triangles(const CsvFile &table, const CsvFile::Line &line, int n_nodes, fem::Picture &picture)
{
  std::vector<int> corner;
  for (std::size_t column = 0; column < line.cells.size(); ++column)
    if (column < 3 || !line.cells[column].empty())
    {
      const int node = table.integer(line, column);
      if (node < 1 || node > n_nodes)
        throw std::invalid_argument(table.place(line.number) + "there is no node " + std::to_string(node) +
                                    "; the table of nodes has 1 to " + std::to_string(n_nodes));
      corner.push_back(node - 1);
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

} // namespace

std::vector<TableNode> read_node_table(const SceneTable &frame, Eigen::Index n)
{
  std::vector<TableNode> nodes;
  if (!frame.has("nodes"))
    return nodes;
  const std::string path = frame.file("nodes");
  try
  {
    const CsvFile table  = read_csv(path);
    const Layout  layout = layout_of(table);
    for (const auto &line : table.lines)
      nodes.push_back(read_node(table, line, layout, n));
  }
  catch (const std::invalid_argument &e)
  {
    throw frame.error("nodes", e.what());
  }
  return nodes;
}

fem::Picture read_node_picture(const SceneTable &frame, const std::vector<TableNode> &nodes, Eigen::Index n)
{
  fem::Picture picture;
  for (const std::string key : {"triangles", "node_displacements"})
    if (frame.has(key) && nodes.empty())
      throw frame.error(key, "is about the nodes of a table; add nodes = \"nodes.csv\"");
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
             add_triangles(table, line, int(nodes.size()), picture);
         });
  placed("node_displacements",
         [&](const std::string &path)
         {
           picture.displacement = coupling::read_matrix_file(path);
           if (picture.displacement.rows() != Eigen::Index(3 * nodes.size()) || picture.displacement.cols() != n)
             throw std::invalid_argument(path + ": is " + std::to_string(picture.displacement.rows()) + " x " +
                                         std::to_string(picture.displacement.cols()) + ", but must be " +
                                         std::to_string(3 * nodes.size()) + " x " + std::to_string(n) +
                                         ": three rows for every node, one column for every row of the mass matrix");
         });
  return picture;
}

} // namespace gestell::apps
