#include "coupling/plugin/frame/converge_mesh.h"

#include "coupling/algebra/dense_modes.h"
#include "coupling/frame/mesh_extrapolation.h"
#include "coupling/integration/system/dense_solvers.h"
#include "coupling/modes/modes.h"
#include "coupling/plugin/frame/prestressed.h"
#include "coupling/reduction/reduce_frame.h"
#include "fem/mesh/cell_measures.h"
#include "fem/mesh/curved_sides.h"
#include "fem/mesh/memory_estimate.h"
#include "fem/mesh/mesher.h"
#include "fem/recovery/mesh_error.h"
#include "fem/recovery/refinement.h"
#include "fem/values/vector3.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <optional>
#include <stdexcept>

namespace gestell::coupling
{

namespace
{

using Eigen::MatrixXd;
using Eigen::VectorXd;

void require(bool holds, const std::string &message)
{
  if (!holds)
    throw std::invalid_argument("mesh convergence: " + message);
}

/// A field whose error is estimated, and the quantity computed from it.
struct Watched
{
  std::string name, unit;
  VectorXd    p;      // in the coordinates of the reduced frame
  double      energy; // p^T C* p [J]
  double      value;
  bool        is_frequency;
};

/// Length that makes rotations comparable with displacements: largest distance of an interface from their centre [m].
double reach_of(const std::vector<fem::Interface> &interfaces)
{
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  double          reach  = 0.;
  for (const auto &interface : interfaces)
    centre += Eigen::Map<const Eigen::Vector3d>(interface.position.data()) / double(interfaces.size());
  for (const auto &interface : interfaces)
    reach = std::max(reach, (Eigen::Map<const Eigen::Vector3d>(interface.position.data()) - centre).norm());
  return reach > 0. ? reach : 1.;
}

/// S^+ in coordinates whose rotations are measured in `reach`, brought back to radians.
MatrixXd compliance(const ReducedFrame &frame)
{
  const int n1    = frame.n_interface;
  VectorXd  scale = VectorXd::Ones(n1);
  for (const auto &interface : frame.interfaces)
    for (int k = 3; k < 6; ++k)
      if (interface.coordinate[k] >= 0)
        scale[interface.coordinate[k]] = 1. / reach_of(frame.interfaces);
  const SymmetricEigenSolver S(scale.asDiagonal() * frame.C.topLeftCorner(n1, n1) * scale.asDiagonal());
  const double               largest  = S.eigenvalues().size() > 0 ? S.eigenvalues().maxCoeff() : 0.;
  constexpr double           singular = 1e-9; // eigenvalue of the scaled S below which a motion is rigid
  const VectorXd inverse = S.eigenvalues().unaryExpr([&](double s) { return s > singular * largest ? 1. / s : 0.; });
  const MatrixXd U       = scale.asDiagonal() * S.eigenvectors();
  return U * inverse.asDiagonal() * U.transpose();
}

std::vector<Watched> watch_frequencies(const ReducedFrame &frame, int count)
{
  const int            n_rigid = frame.n_rigid();
  const DenseModes     modes   = dense_modes(frame.C, frame.M, cancelled_by_reduction, n_rigid);
  std::vector<Watched> result;
  const auto           known = [&](Eigen::Index j)
  { return j < modes.omega.size() && j < frame.frequency_error.size() && !std::isnan(frame.frequency_error[j]); };
  for (Eigen::Index j = n_rigid; known(j) && j < n_rigid + count; ++j)
    result.push_back({"frequency " + std::to_string(j - n_rigid + 1), "Hz", modes.V.col(j),
                      modes.omega[j] * modes.omega[j], refined_hz(frame, j), true});
  return result;
}

/// Interfaces at a node of the mesh, or at the triangles that meet in a point: under a force spread over no area of its
/// own a continuum yields without limit, the more the finer the mesh.
std::vector<std::string> at_points(const fem::FrameSpecification &specification)
{
  std::vector<std::string> names;
  for (const auto &interface : specification.interfaces)
    if (interface.coupling == fem::InterfaceCoupling::node ||
        (interface.coupling == fem::InterfaceCoupling::point && interface.radius == 0.))
      names.push_back(interface.name);
  return names;
}

std::vector<Watched> watch_compliances(const ReducedFrame &frame, const fem::FrameSpecification &specification)
{
  const auto           points = at_points(specification);
  const MatrixXd       F      = compliance(frame);
  std::vector<Watched> result;
  for (const auto &interface : frame.interfaces)
  {
    if (std::find(points.begin(), points.end(), interface.name) != points.end())
      continue;
    std::vector<int> translations;
    for (int k = 0; k < 3; ++k)
      if (interface.coordinate[k] >= 0)
        translations.push_back(interface.coordinate[k]);
    if (translations.empty())
      continue;
    const SymmetricEigenSolver block(MatrixXd(F(translations, translations)));
    const double               largest = block.eigenvalues().tail<1>()[0];
    if (!(largest > 0.))
      continue; // one interface of a floating frame: no forces in balance
    VectorXd p                = VectorXd::Zero(frame.M.rows());
    p.head(frame.n_interface) = F(Eigen::all, translations) * block.eigenvectors().rightCols(1);
    result.push_back({"compliance of " + interface.name, "m/N", p, largest, largest, false});
  }
  return result;
}

/// One mesh with its reduced frame and its error estimate.
struct Computed
{
  MeshLevel                             level;
  std::vector<Watched>                  watched;
  VectorXd                              eta2; // [n_cells] of all fields, each relative to its energy
  std::shared_ptr<const fem::MeshError> mesh_error;
  ReducedFrame                          frame;
};

Computed compute(const fem::FrameSpecification &specification, const fem::Mesh &mesh, const ReductionOptions &reduction,
                 const ConvergenceOptions &options, const Progress &progress)
{
  if (progress)
    progress("assembly", -1.);
  const auto [matrices, mesh_error, load, geometric, balance] =
      discretised(mesh, specification, reduction.factor, progress);
  ReducedModel reduced = reduce_with_basis(matrices, reduction, progress);
  Computed     result;
  result.frame      = std::move(reduced.frame);
  result.mesh_error = mesh_error;
  result.watched    = watch_frequencies(result.frame, options.n_frequencies);
  if (options.compliances)
    for (Watched &compliance : watch_compliances(result.frame, specification))
      result.watched.push_back(std::move(compliance));

  MatrixXd fields(matrices.M.rows(), result.watched.size());
  for (std::size_t j = 0; j < result.watched.size(); ++j)
    fields.col(j) = reduced.basis.T * result.watched[j].p;
  const MatrixXd eta2 = mesh_error->of_cells(fields);
  result.eta2         = VectorXd::Zero(eta2.rows());
  for (std::size_t j = 0; j < result.watched.size(); ++j)
  {
    const Watched &watched = result.watched[j];
    const double   share   = eta2.col(j).sum() / watched.energy;
    result.eta2 += eta2.col(j) / watched.energy;
    result.level.names.push_back(watched.name);
    result.level.values.push_back(watched.value);
    result.level.estimates.push_back(watched.is_frequency ? fem::relative_frequency_error(share) : share);
  }
  result.level.n_cells       = matrices.n_cells;
  result.level.n_coordinates = static_cast<int>(matrices.M.rows());
  return result;
}

/// @param levels   with the same quantities each.
/// @param watched  of the last mesh, those of the levels among them.
std::vector<ConvergedQuantity> extrapolate_all(const std::vector<MeshLevel> &levels,
                                               const std::vector<Watched>   &watched)
{
  std::vector<ConvergedQuantity> result;
  for (std::size_t j = 0; j < levels.back().names.size(); ++j)
  {
    const std::string &name = levels.back().names[j];
    const auto of = std::find_if(watched.begin(), watched.end(), [&](const Watched &w) { return w.name == name; });
    std::vector<MeshValue> meshes;
    for (const MeshLevel &level : levels)
      meshes.push_back({double(level.n_coordinates), level.values[j], level.estimates[j]});
    const Extrapolated limit = extrapolate(meshes, of->is_frequency ? Approach::from_above : Approach::from_below);
    result.push_back({name, of->unit, limit.limit, limit.uncertainty, meshes.back().value / limit.limit - 1.,
                      limit.order, limit.regular, limit.n_meshes});
  }
  return result;
}

bool converged(const std::vector<ConvergedQuantity> &quantities, double tolerance)
{
  return std::all_of(quantities.begin(), quantities.end(),
                     [tolerance](const ConvergedQuantity &quantity)
                     { return quantity.n_meshes > 1 && quantity.bound() <= tolerance; });
}

const ConvergedQuantity &worst(const std::vector<ConvergedQuantity> &quantities)
{
  return *std::max_element(quantities.begin(), quantities.end(),
                           [](const ConvergedQuantity &a, const ConvergedQuantity &b)
                           { return a.bound() < b.bound(); });
}

/// "; frequency 1 would need about 60000 coordinates if ...", rounded up to two digits; "" where the error is unknown.
std::string enough(const ConvergedQuantity &worst, int n_coordinates, double tolerance)
{
  if (worst.bound() <= tolerance)
    return "";                                                        // but no other mesh to compare with
  constexpr double least_k = 0.5, usual_k = 1., greatest_k = 4. / 3.; // k of error ~ n^-k, to estimate n
  const double     k = std::isnan(worst.order) ? usual_k : std::clamp(worst.order, least_k, greatest_k);
  const double     n = n_coordinates * std::pow(worst.bound() / tolerance, 1. / k);
  if (!(n < 1e12))
    return "";
  const double digits = std::pow(10., std::floor(std::log10(n)) - 1.);
  std::string  order  = std::to_string(k);
  order.erase(order.find('.') + 2);
  return "; " + worst.name + " would need about " + std::to_string(std::llround(std::ceil(n / digits) * digits)) +
         " DOFs if its error falls with their number to the power -" + order;
}

void check(const fem::FrameSpecification &specification, const ConvergenceOptions &options)
{
  require(options.tolerance > 0. && options.tolerance < 1.,
          "the tolerance is " + std::to_string(options.tolerance) + "; give a ratio such as 0.01 for 1 %.");
  require(options.n_frequencies >= 1, "at least one frequency is needed.");
  require(options.max_meshes >= 2, "at least two meshes are needed for a difference.");
  require(specification.mesh.size > 0., specification.cad +
                                            " is a mesh, which cannot be refined; give the geometry (.step, .brep, "
                                            ".geo), or use a finer mesh in the program that made it.");
}

/// Whether the first mesh has all frequencies that are to be watched.
void check(const Computed &first, const ConvergenceOptions &options)
{
  const auto n =
      std::count_if(first.watched.begin(), first.watched.end(), [](const Watched &w) { return w.is_frequency; });
  require(n == options.n_frequencies,
          std::to_string(options.n_frequencies) +
              " frequencies are requested, but the reduced frame of the first mesh has " + std::to_string(n) +
              " elastic modes with a known error; request at most these (--frequencies " +
              std::to_string(std::max<long>(1, n)) + "), or retain more modes ([reduction] modes).");
}

double skin_area(const fem::Mesh &mesh)
{
  using fem::operator-;
  double     area = 0.;
  for (const auto &[a, b, c] : mesh.skin)
    area += 0.5 * fem::norm(fem::cross(mesh.points[b] - mesh.points[a], mesh.points[c] - mesh.points[a]));
  return area;
}

/// Nodes that interfaces average: two to a triangle.
double averaged_nodes(const fem::Mesh &mesh, const fem::FrameSpecification &specification)
{
  double n = 0.;
  for (const auto &interface : specification.interfaces)
    if (interface.coupling == fem::InterfaceCoupling::average)
      for (const std::string &surface : interface.surfaces)
        n += 2. * double(mesh.surfaces.at(surface).size());
  return n;
}

/// The meshes of a convergence, one after the other.
class Meshes
{
public:
  Meshes(const fem::FrameSpecification &specification, const ConvergenceOptions &options)
      : specification_(specification), options_(options), first_size_(specification.mesh.size)
  {
    specification_.mesh.max_cells = options.max_coordinates; // its size is judged by its coordinates
  }

  const fem::FrameSpecification &specification() const { return specification_; }
  const std::string             &stopped() const { return stopped_; }

  fem::Mesh first(const Progress &progress)
  {
    fem::Mesh mesh = fem::make_mesh(specification_, progress, {});
    n_nodes_       = fem::number_of_nodes(mesh);
    compactness_   = fem::compactness(fem::curved_volume(mesh), skin_area(mesh));
    n_averaged_    = averaged_nodes(mesh, specification_);
    n_first_       = 3. * n_nodes_;
    return mesh;
  }

  /**
   * Makes a mesh with `growth` times the coordinates of the last one, or with as many as are allowed. Returns none if
   * those are hardly more than the last mesh had or gmsh cannot refine further; stopped() then gives the reason.
   * @param by_itself  a script or the sweeping of plates makes the mesh, with a single size.
   */
  std::optional<fem::Mesh> next(const Computed &last, bool by_itself, double growth, const Progress &progress)
  {
    const double     last_size       = specification_.mesh.size;
    const double     n0              = last.level.n_coordinates;
    const double     allowed         = std::min<double>(options_.max_coordinates, fitting());
    constexpr double filled          = 0.9; // of the coordinates allowed, where a mesh is cut down to them
    const double     room            = filled * allowed;
    constexpr double greatest_graded = 3.; // of those that are graded: rough estimates grade badly
    double           wanted          = (by_itself ? growth : std::min(growth, greatest_graded)) * n0;
    double           ratio           = wanted / n0;
    for (int trial = 1;; ++trial)
    {
      fem::Mesh        mesh  = by_itself ? finer_everywhere(last_size, ratio, progress) : finer(last, ratio, progress);
      const double     nodes = fem::number_of_nodes(mesh);
      const double     n     = n0 * nodes / n_nodes_; // some nodes are fixed and have no coordinates
      const bool       fits  = n <= allowed;
      constexpr double clearly_finer = 1.5; // times the coordinates, at least, of a mesh that is not cut down
      if (fits && n >= (trial > 1 ? distinctly_finer : clearly_finer) * n0)
      {
        n_nodes_ = nodes;
        return mesh;
      }
      constexpr int most_trials = 4; // of one size: gmsh meets the wanted number of cells to some ten per cent
      if (trial == most_trials || (!fits && room < distinctly_finer * n0))
      {
        stopped_ = fits ? "gmsh cannot make a mesh with clearly more than " + std::to_string(std::lround(n0)) + " DOFs"
                        : "the next mesh would have " + std::to_string(std::lround(n)) + " DOFs, more than the " +
                              (allowed < options_.max_coordinates
                                   ? std::to_string(std::lround(allowed)) + " that the available memory of " +
                                         fem::memory_text(available()) + " allows"
                                   : std::to_string(options_.max_coordinates) + " allowed");
        return {};
      }
      // n = n0 ratio^a
      wanted         = std::min(wanted, room);
      const double a = std::log(n / n0) / std::log(ratio);
      ratio          = a > 0.2 ? std::pow(wanted / n0, 1. / a) : 2. * ratio;
    }
  }

private:
  fem::Mesh finer(const Computed &last, double growth, const Progress &progress) const
  {
    fem::Refinement refinement;
    refinement.growth       = growth;
    refinement.largest      = first_size_;
    constexpr double finest = 1e-3; // smallest element over the size of the first mesh
    refinement.smallest     = finest * first_size_;
    return fem::make_mesh(specification_, progress, fem::refine(*last.mesh_error, last.eta2, refinement));
  }

  /// For swept plates, or a script that makes its own mesh.
  fem::Mesh finer_everywhere(double size, double growth, const Progress &progress)
  {
    specification_.mesh.size = size * std::pow(growth, -1. / 3.);
    return fem::make_mesh(specification_, progress, {});
  }

  double available() const { return options_.memory > 0. ? options_.memory : fem::available_memory(); }

  /// Coordinates whose reduction fits into the memory; nodes on a surface grow like n^(2/3).
  double fitting() const
  {
    const auto memory = [&](double n)
    {
      return fem::reduction_memory(n, compactness_, n_averaged_ * std::pow(n / n_first_, 2. / 3.)) +
             (specification_.prestress ? fem::prestress_memory(n) : 0.);
    };
    double n = options_.max_coordinates;
    while (n > n_first_ && memory(n) > available())
      n *= 0.95;
    return n;
  }

  fem::FrameSpecification   specification_;
  const ConvergenceOptions &options_;
  double                    first_size_;
  double                    n_nodes_     = 0.; // of the last mesh
  double                    n_first_     = 1.; // coordinates of the first mesh
  double                    compactness_ = 0., n_averaged_ = 0.;
  std::string               stopped_;
};

} // namespace

MeshConvergence converge_mesh(fem::FrameSpecification specification, const ReductionOptions &reduction,
                              const ConvergenceOptions &options, const Progress &progress)
{
  check(specification, options);
  int        number = 1;
  const auto phases = [&](const std::string &phase, double share)
  {
    if (progress)
      progress("mesh " + std::to_string(number) + ": " + phase, share);
  };
  const auto cpu_seconds = [] { return double(std::clock()) / CLOCKS_PER_SEC; };

  Meshes                   meshes(specification, options);
  MeshConvergence          result;
  Computed                 last;
  double                   begin = cpu_seconds();
  std::optional<fem::Mesh> mesh  = meshes.first(phases);
  while (mesh)
  {
    last             = compute(meshes.specification(), *mesh, reduction, options, phases);
    last.level.size  = meshes.specification().mesh.size;
    last.level.cpu_s = cpu_seconds() - begin;
    if (number == 1)
      check(last, options);
    result.levels.push_back(last.level);
    for (const std::string &name : keep_common(result.levels))
      if (std::find(result.left_out.begin(), result.left_out.end(), name) == result.left_out.end())
        result.left_out.push_back(name);
    result.quantities  = extrapolate_all(result.levels, last.watched);
    const double bound = worst(result.quantities).bound();
    result.converged   = converged(result.quantities, options.tolerance);
    if (options.after_mesh)
      options.after_mesh(result);
    if (result.converged)
      break;
    if (number++ == options.max_meshes)
    {
      result.stopped = std::to_string(options.max_meshes) + " meshes is the limit";
      break;
    }
    begin                = cpu_seconds();
    constexpr double aim = 0.6; // of the tolerance: what a mesh is made for, as estimates err
    // of the cells from mesh to mesh: 1.3 to 1.7 times as fine, so that orders show
    constexpr double least_growth = 2.2, greatest_growth = 5.;
    const double     growth = std::clamp(bound / (aim * options.tolerance), least_growth, greatest_growth);
    mesh                    = meshes.next(last, mesh->takes_one_size, growth, phases);
    result.stopped          = meshes.stopped();
  }
  if (options.compliances)
    result.at_points = at_points(specification);
  if (!result.converged)
    result.stopped += enough(worst(result.quantities), result.levels.back().n_coordinates, options.tolerance);
  result.frame = std::move(last.frame);
  return result;
}

} // namespace gestell::coupling
