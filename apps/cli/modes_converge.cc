#include "apps/cli/modes_converge.h"

#include "apps/output/folder/own_folder.h"
#include "apps/output/text/csv.h"
#include "coupling/plugin/mesh_service.h"
#include "fem/values/number_text.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <iostream>
#include <sstream>

namespace gestell::apps
{

namespace
{

std::string percent(double share, int digits = 2)
{
  return short_text(100. * share, digits) + " %";
}

/// Full precision.
std::string number(double value)
{
  std::ostringstream text;
  text << std::setprecision(17) << value;
  return text.str();
}

double largest_bound(const coupling::MeshConvergence &convergence, const std::string &kind)
{
  double largest = 0.;
  for (const auto &quantity : convergence.quantities)
    if (quantity.name.rfind(kind, 0) == 0)
      largest = std::max(largest, quantity.bound());
  return largest;
}

/// "frequencies within 0.7 %, compliances within 1.5 %"
std::string reached(const coupling::MeshConvergence &convergence)
{
  const double compliances = largest_bound(convergence, "compliance");
  return "frequencies within " + percent(largest_bound(convergence, "frequency")) +
         (compliances > 0. ? ", compliances within " + percent(compliances) : "");
}

} // namespace

coupling::MeshConvergence converge_frame(const Scene &scene, const ConvergeOptions &requested,
                                         const std::filesystem::path &folder, const coupling::Progress &progress)
{
  if (scene.frame.source == FrameSource::parts)
    throw std::invalid_argument(scene.file +
                                ": --converge refines the mesh of one frame, but this frame consists of "
                                "parts; converge each part as a separate frame, or set mesh.size of the parts");
  if (scene.frame.source != FrameSource::geometry || frame_path(scene) != FramePath::reduce)
    throw std::invalid_argument(
        scene.file + ": --converge refines the mesh of a frame, but the frame of this scene has no geometry or is not "
                     "reduced; set [frame] cad = \"FILE\" and reduction.method = \"craig-bampton\"");
  coupling::ConvergenceOptions options;
  options.tolerance       = requested.converge;
  options.n_frequencies   = requested.frequencies;
  options.max_coordinates = requested.max_coordinates;
  options.compliances     = requested.watch == "all";
  options.after_mesh      = [&folder](const coupling::MeshConvergence &so_far) { write_convergence(folder, so_far); };
  return coupling::mesh_service().converge(scene.frame.geometry, scene.reduction.options, options, progress);
}

void print_convergence(const coupling::MeshConvergence &convergence, double tolerance)
{
  std::cout << "meshes\n  largest cell [m]     cells          DOFs     CPU s";
  for (const auto &quantity : convergence.quantities)
    std::cout << "   " << quantity.name << " [" << quantity.unit << "]";
  std::cout << '\n';
  for (const coupling::MeshLevel &level : convergence.levels)
  {
    std::cout << std::setw(18) << short_text(level.size, 3) << std::setw(10) << level.n_cells << std::setw(14)
              << level.n_coordinates << std::setw(10) << short_text(level.cpu_s, 3);
    for (std::size_t j = 0; j < level.values.size(); ++j)
      std::cout << std::setw(static_cast<int>(convergence.quantities[j].name.size() +
                                              convergence.quantities[j].unit.size() + 6))
                << short_text(level.values[j], 6);
    std::cout << '\n';
  }
  std::cout << "the last mesh\n  value          limit          error          uncertainty    order   quantity\n";
  for (std::size_t j = 0; j < convergence.quantities.size(); ++j)
  {
    const coupling::ConvergedQuantity &quantity = convergence.quantities[j];
    std::cout << "  " << std::left << std::setw(15) << short_text(convergence.levels.back().values[j], 6)
              << std::setw(15) << short_text(quantity.limit, 6) << std::setw(15) << percent(quantity.error)
              << std::setw(15) << percent(quantity.uncertainty) << std::setw(8)
              << (std::isnan(quantity.order) ? "-" : short_text(quantity.order, 2)) << quantity.name << " ["
              << quantity.unit << "]" << (quantity.regular ? "" : ", does not converge regularly") << std::right
              << '\n';
  }
  std::cout << reached(convergence) << ", uncertainty included: " << (convergence.converged ? "" : "not all ")
            << "within " << percent(tolerance) << (convergence.converged ? "" : "; " + convergence.stopped) << '\n';
}

std::vector<std::string> convergence_warnings(const coupling::MeshConvergence &convergence, double tolerance)
{
  std::vector<std::string> warnings;
  for (const std::string &name : convergence.left_out)
    warnings.push_back("mesh: " + name + " is omitted, because not every mesh has it; retain more modes of the frame");
  for (const std::string &name : convergence.at_points)
    warnings.push_back("mesh: the compliance of " + name +
                       " is not checked: under a point force it grows without limit as elements shrink; to check it, "
                       "couple a surface (coupling = \"average\" or \"rigid\")");
  if (!convergence.converged)
    warnings.push_back("mesh: " + reached(convergence) + ", not all within " + percent(tolerance) + ": " +
                       convergence.stopped);
  return warnings;
}

void write_convergence(const std::filesystem::path &folder, const coupling::MeshConvergence &convergence)
{
  std::vector<std::string> heads{"mesh", "largest cell [m]", "cells", "coordinates", "CPU time [s]"};
  for (const auto &quantity : convergence.quantities)
    heads.insert(heads.end(), {quantity.name + " [" + quantity.unit + "]", quantity.name + " estimated error"});
  CsvTable csv(heads);
  int      mesh = 0;
  for (const coupling::MeshLevel &level : convergence.levels)
  {
    std::vector<std::string> values;
    for (std::size_t j = 0; j < level.values.size(); ++j)
      values.insert(values.end(), {number(level.values[j]), number(level.estimates[j])});
    csv.add(++mesh, number(level.size), level.n_cells, level.n_coordinates, number(level.cpu_s), values);
  }
  using Quantity = coupling::ConvergedQuantity;
  for (const auto &[name, part] : {std::pair("limit", &Quantity::limit),
                                   {"uncertainty", &Quantity::uncertainty},
                                   {"error", &Quantity::error},
                                   {"order", &Quantity::order}})
  {
    std::vector<std::string> values;
    for (const Quantity &quantity : convergence.quantities)
      values.insert(values.end(), {number(quantity.*part), ""});
    csv.add(name, "", "", "", "", values);
  }
  OwnFolder(folder).write("mesh_convergence.csv", csv);
}

} // namespace gestell::apps
