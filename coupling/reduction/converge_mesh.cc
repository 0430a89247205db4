#include "coupling/reduction/converge_mesh.h"

#include "coupling/dense_modes.h"
#include "coupling/mesh_extrapolation.h"
#include "coupling/reduction/craig_bampton.h"
#include "coupling/reduction/team_assembly.h"
#include "fem/discretisation.h"
#include "fem/hexahedral_mesh.h"
#include "fem/mesh_error.h"
#include "fem/mesher.h"
#include "fem/size_field.h"

#include <Eigen/Eigenvalues>

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

constexpr double two_pi     = 6.283185307179586;
constexpr double cancelled  = 1e-10;                     // as in supported_modes()
constexpr double singular   = 1e-9;                      // eigenvalue of the scaled S below which a motion is rigid
constexpr double aim        = 0.6;                       // of the tolerance: what a mesh is made for
constexpr double least_fall = 0.2, greatest_fall = 0.45; // of the error from mesh to mesh
constexpr double finest      = 1e-3;                     // smallest element over the size of the first mesh
constexpr double filled      = 0.9;                      // of the coordinates allowed, where a mesh is cut down to them
constexpr double growth      = 1.2; // of coordinates, at least: less shows no difference between meshes
constexpr int    most_trials = 4;

void require(bool holds, const std::string &message)
{
  if (!holds)
    throw std::invalid_argument("mesh convergence: " + message);
}

/// A field whose error is estimated, and the quantity it makes.
struct Watched
{
  std::string name, unit;
  VectorXd    p;      // in the coordinates of the reduced frame
  double      energy; // p^T C* p [J]
  double      value;
  bool        is_frequency;
};

/// Length that makes rotations comparable with displacements: the reach of the interfaces about their centre [m].
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
  const Eigen::SelfAdjointEigenSolver<MatrixXd> S(scale.asDiagonal() * frame.C.topLeftCorner(n1, n1) *
                                                  scale.asDiagonal());
  const double                                  largest = S.eigenvalues().size() > 0 ? S.eigenvalues().maxCoeff() : 0.;
  const VectorXd inverse = S.eigenvalues().unaryExpr([&](double s) { return s > singular * largest ? 1. / s : 0.; });
  const MatrixXd U       = scale.asDiagonal() * S.eigenvectors();
  return U * inverse.asDiagonal() * U.transpose();
}

std::vector<Watched> watch_frequencies(const ReducedFrame &frame, int count)
{
  const DenseModes     modes   = dense_modes(frame.C, frame.M, cancelled);
  const auto           n_rigid = (frame.frequencies_hz.array() == 0.).count(); // as the full frame counts them
  std::vector<Watched> result;
  const auto           known = [&](Eigen::Index j)
  { return j < modes.omega.size() && j < frame.frequency_error.size() && !std::isnan(frame.frequency_error[j]); };
  for (Eigen::Index j = n_rigid; known(j) && j < n_rigid + count; ++j)
    result.push_back({"frequency " + std::to_string(j - n_rigid + 1), "Hz", modes.V.col(j),
                      modes.omega[j] * modes.omega[j], frame.frequencies_hz[j] / (1. + frame.frequency_error[j]),
                      true});
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
    const Eigen::SelfAdjointEigenSolver<MatrixXd> block(MatrixXd(F(translations, translations)));
    const double                                  largest = block.eigenvalues().tail<1>()[0];
    if (!(largest > 0.))
      continue; // one interface of a floating frame: no forces in balance
    VectorXd p                = VectorXd::Zero(frame.M.rows());
    p.head(frame.n_interface) = F(Eigen::all, translations) * block.eigenvectors().rightCols(1);
    result.push_back({"compliance of " + interface.name, "m/N", p, largest, largest, false});
  }
  return result;
}

/// One mesh from CAD to its reduced frame, with what it says about its own errors.
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
  const auto [matrices, mesh_error, rows] = fem::discretise_with_mesh_error(mesh, specification, team_assembly());
  Reduction reduced                       = craig_bampton_with_basis(matrices, reduction, progress, rows.get());
  Computed  result;
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
    const Extrapolated limit = extrapolate(meshes);
    result.push_back(
        {name, of->unit, limit.limit, limit.uncertainty, meshes.back().value / limit.limit - 1., limit.order});
  }
  return result;
}

double largest_bound(const std::vector<ConvergedQuantity> &quantities)
{
  double largest = 0.;
  for (const auto &quantity : quantities)
    largest = std::max(largest, quantity.bound());
  return largest;
}

void check(const fem::FrameSpecification &specification, const ConvergenceOptions &options)
{
  require(options.tolerance > 0. && options.tolerance < 1.,
          "the tolerance is " + std::to_string(options.tolerance) + "; give a share such as 0.01 for 1 %.");
  require(options.n_frequencies >= 1, "at least one frequency must be watched.");
  require(options.max_meshes >= 2, "two meshes at least are needed to see a difference.");
  require(specification.mesh.size > 0., specification.cad +
                                            " is a mesh, which cannot be refined; give the geometry (.step, .brep, "
                                            ".geo), or mesh finer where it was made.");
}

/// Whether the first mesh has all frequencies that are to be watched.
void check(const Computed &first, const ConvergenceOptions &options)
{
  const auto n =
      std::count_if(first.watched.begin(), first.watched.end(), [](const Watched &w) { return w.is_frequency; });
  require(n == options.n_frequencies, std::to_string(options.n_frequencies) +
                                          " frequencies are to be watched, but the reduced frame of the first "
                                          "mesh has " +
                                          std::to_string(n) +
                                          " elastic modes with a known error; watch no more than these "
                                          "(--frequencies " +
                                          std::to_string(std::max<long>(1, n)) +
                                          "), or keep more modes ([reduction] modes).");
}

/// The meshes of a convergence, one after the other.
class Meshes
{
public:
  Meshes(const fem::FrameSpecification &specification, const ConvergenceOptions &options)
      : specification_(specification), options_(options), first_size_(specification.mesh.size)
  {
    specification_.mesh.max_cells = options.max_coordinates; // judged by its coordinates
  }

  const fem::FrameSpecification &specification() const { return specification_; }
  const std::string             &stopped() const { return stopped_; }

  fem::Mesh first(const Progress &progress) const { return fem::make_mesh(specification_, progress, {}); }

  /**
   * A mesh with `fall` of the error of the last one, or as much as the coordinates allowed have room for; none where
   * that is no more than the last one had, and stopped() says so.
   */
  std::optional<fem::Mesh> next(const Computed &last, bool hexahedra, double fall, const Progress &progress)
  {
    const double last_size = specification_.mesh.size;
    for (int trial = 1;; ++trial)
    {
      fem::Mesh    mesh = hexahedra ? finer_everywhere(last_size, fall, progress) : finer(last, fall, progress);
      const double n    = 3. * fem::number_of_nodes(mesh);
      if (n <= options_.max_coordinates)
        return mesh;
      const double least = growth * last.level.n_coordinates, wanted = filled * options_.max_coordinates;
      if (trial == most_trials || wanted < least)
      {
        stopped_ = "the next mesh would have " + std::to_string(std::lround(n)) + " coordinates, more than the " +
                   std::to_string(options_.max_coordinates) + " allowed";
        return {};
      }
      // error ~ n^-k
      const double k = std::log(fall) / std::log(last.level.n_coordinates / n);
      fall           = std::pow(last.level.n_coordinates / wanted, k);
    }
  }

private:
  fem::Mesh finer(const Computed &last, double fall, const Progress &progress) const
  {
    fem::Refinement refinement;
    refinement.error    = fall;
    refinement.largest  = first_size_;
    refinement.smallest = finest * first_size_;
    return fem::make_mesh(specification_, progress, fem::refine(*last.mesh_error, last.eta2, refinement));
  }

  /// Of a script that meshes by itself.
  fem::Mesh finer_everywhere(double size, double fall, const Progress &progress)
  {
    specification_.mesh.size = size * std::pow(fall, 1. / (2. * fem::order_of_refinement));
    return fem::make_mesh(specification_, progress, {});
  }

  fem::FrameSpecification   specification_;
  const ConvergenceOptions &options_;
  double                    first_size_;
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
    const double bound = largest_bound(result.quantities);
    result.converged   = number > 1 && bound <= options.tolerance;
    if (result.converged)
      break;
    if (number++ == options.max_meshes)
    {
      result.stopped = std::to_string(options.max_meshes) + " meshes were allowed";
      break;
    }
    begin             = cpu_seconds();
    const double fall = std::clamp(aim * options.tolerance / bound, least_fall, greatest_fall);
    mesh              = meshes.next(last, !mesh->hexahedra.empty(), fall, phases);
    result.stopped    = meshes.stopped();
  }
  if (options.compliances)
    result.at_points = at_points(specification);
  result.frame = std::move(last.frame);
  return result;
}

} // namespace gestell::coupling
