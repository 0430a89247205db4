// Error of frequencies against coordinates and CPU time for several kinds of meshes, from the tables that
// `gestell modes SCENE --converge` leaves; docs/develop/benchmarks.md has the commands.
//
//   gestell_mesh_chart FOLDER REFERENCE.csv NAME=TABLE.csv ...
//
// FOLDER/error_coordinates.svg and FOLDER/error_cpu.svg: the largest error of the frequencies of each mesh against
// those of the last mesh of the reference.

#include "apps/analysis/result_folder.h"
#include "apps/output/charts/chart.h"
#include "apps/output/text/write_file.h"
#include "apps/scene/file/csv_file.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <iostream>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

namespace
{

using namespace gestell;

struct MeshPoint
{
  double              coordinates, cpu_s;
  std::vector<double> frequencies;
};

/// The meshes of a table; its last rows tell limits and orders.
std::vector<MeshPoint> read_meshes(const std::string &file)
{
  const apps::CsvFile    table = apps::read_csv(file);
  std::vector<MeshPoint> points;
  for (const auto &line : table.lines)
  {
    if (line.cells[0].find_first_not_of("0123456789") != std::string::npos)
      continue;
    MeshPoint point{std::nan(""), std::nan(""), {}};
    for (std::size_t column = 0; column < table.head.size(); ++column)
    {
      const std::string &head = table.head[column];
      if (head == "coordinates")
        point.coordinates = table.number(line, column);
      else if (head == "CPU time [s]")
        point.cpu_s = table.number(line, column);
      else if (head.rfind("frequency ", 0) == 0 && head.find("error") == std::string::npos)
        point.frequencies.push_back(table.number(line, column));
    }
    points.push_back(point);
  }
  if (points.empty() || points.front().frequencies.empty())
    throw std::invalid_argument(file + " has no mesh with frequencies; it is made by `gestell modes SCENE --converge`");
  return points;
}

double largest_error(const MeshPoint &point, const MeshPoint &reference)
{
  double largest = 0.;
  for (std::size_t j = 0; j < std::min(point.frequencies.size(), reference.frequencies.size()); ++j)
    largest = std::max(largest, std::abs(point.frequencies[j] / reference.frequencies[j] - 1.));
  return largest;
}

void draw(const std::string &file, const std::string &x_label, double MeshPoint::*abscissa, const MeshPoint &reference,
          const std::vector<std::pair<std::string, std::vector<MeshPoint>>> &kinds)
{
  apps::Chart chart;
  chart.title   = "Largest error of the first four elastic frequencies";
  chart.x.label = x_label;
  chart.y.label = "error [%]";
  chart.x.scale = chart.y.scale = apps::Scale::logarithmic;
  int colour                    = 0;
  for (const auto &[name, points] : kinds)
  {
    apps::Curve curve{name, {}, {}, colour++, apps::LineStyle::full, apps::Marker::ring};
    for (const MeshPoint &point : points)
      curve.add(point.*abscissa, 100. * largest_error(point, reference));
    chart.panels[0].curves.push_back(curve);
  }
  apps::write_file(file, apps::chart_svg(chart));
}

} // namespace

int main(int argc, char **argv)
{
  try
  {
    if (argc < 4)
      throw std::invalid_argument("usage: gestell_mesh_chart FOLDER REFERENCE.csv NAME=TABLE.csv ...");
    const std::string folder    = argv[1];
    const MeshPoint   reference = read_meshes(argv[2]).back();

    std::vector<std::pair<std::string, std::vector<MeshPoint>>> kinds;
    for (int i = 3; i < argc; ++i)
    {
      const std::string kind = argv[i];
      const auto        sign = kind.find('=');
      if (sign == std::string::npos)
        throw std::invalid_argument("\"" + kind + "\" is no NAME=TABLE.csv");
      kinds.emplace_back(kind.substr(0, sign), read_meshes(kind.substr(sign + 1)));
      for (const MeshPoint &point : kinds.back().second)
        std::cout << kinds.back().first << ": " << point.coordinates << " coordinates, " << point.cpu_s << " s, error "
                  << 100. * largest_error(point, reference) << " %\n";
    }
    draw(folder + "/error_coordinates.svg", "coordinates", &MeshPoint::coordinates, reference, kinds);
    draw(folder + "/error_cpu.svg", "CPU time from CAD to reduced frame [s]", &MeshPoint::cpu_s, reference, kinds);
    return 0;
  }
  catch (const std::exception &error)
  {
    std::cerr << "gestell_mesh_chart: " << error.what() << '\n';
    return 2;
  }
}
