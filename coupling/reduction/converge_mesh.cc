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
constexpr double finest = 1e-3;                          // smallest element over the size of the first mesh

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
  const auto           n_rigid = (modes.omega.array() == 0.).count();
  std::vector<Watched> result;
  for (Eigen::Index j = n_rigid; j < modes.omega.size() && j < n_rigid + count; ++j)
    result.push_back({"frequency " + std::to_string(j - n_rigid + 1), "Hz", modes.V.col(j),
                      modes.omega[j] * modes.omega[j], frame.frequencies_hz[j] / (1. + frame.frequency_error[j]),
                      true});
  return result;
}

std::vector<Watched> watch_compliances(const ReducedFrame &frame)
{
  const MatrixXd       F = compliance(frame);
  std::vector<Watched> result;
  for (const auto &interface : frame.interfaces)
  {
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
  for (Watched &compliance : watch_compliances(result.frame))
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
    result.level.values.push_back(watched.value);
    result.level.estimates.push_back(watched.is_frequency ? fem::relative_frequency_error(share) : share);
  }
  result.level.n_cells       = matrices.n_cells;
  result.level.n_coordinates = static_cast<int>(matrices.M.rows());
  return result;
}

std::vector<ConvergedQuantity> extrapolate_all(const std::vector<MeshLevel> &levels,
                                               const std::vector<Watched>   &watched)
{
  std::vector<ConvergedQuantity> result;
  for (std::size_t j = 0; j < watched.size(); ++j)
  {
    std::vector<MeshValue> meshes;
    for (const MeshLevel &level : levels)
      meshes.push_back({double(level.n_coordinates), level.values[j], level.estimates[j]});
    const Extrapolated limit = extrapolate(meshes);
    result.push_back({watched[j].name, watched[j].unit, limit.limit, limit.uncertainty,
                      meshes.back().value / limit.limit - 1., limit.order});
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

} // namespace

MeshConvergence converge_mesh(fem::FrameSpecification specification, const ReductionOptions &reduction,
                              const ConvergenceOptions &options, const Progress &progress)
{
  check(specification, options);
  const double                first_size = specification.mesh.size;
  MeshConvergence             result;
  Computed                    last;
  std::vector<fem::SizePoint> sizes;
  specification.mesh.max_cells = options.max_coordinates; // judged by its coordinates
  for (int number = 1;; ++number)
  {
    const std::string head   = "mesh " + std::to_string(number) + ": ";
    const Progress    phases = [&](const std::string &phase, double share)
    {
      if (progress)
        progress(head + phase, share);
    };
    const double    begin = double(std::clock()) / CLOCKS_PER_SEC;
    const fem::Mesh mesh  = fem::make_mesh(specification, phases, sizes);
    if (const double n = 3. * fem::number_of_nodes(mesh); n > options.max_coordinates && number > 1)
    {
      result.stopped = "the next mesh would have " + std::to_string(std::lround(n)) + " coordinates, more than the " +
                       std::to_string(options.max_coordinates) + " allowed";
      break;
    }
    last             = compute(specification, mesh, reduction, options, phases);
    last.level.size  = specification.mesh.size;
    last.level.cpu_s = double(std::clock()) / CLOCKS_PER_SEC - begin;
    result.levels.push_back(last.level);
    result.quantities  = extrapolate_all(result.levels, last.watched);
    const double bound = largest_bound(result.quantities);
    result.converged   = number > 1 && bound <= options.tolerance;
    if (result.converged)
      break;
    if (number == options.max_meshes)
    {
      result.stopped = std::to_string(number) + " meshes were allowed";
      break;
    }
    fem::Refinement refinement;
    refinement.error    = std::clamp(aim * options.tolerance / bound, least_fall, greatest_fall);
    refinement.largest  = first_size;
    refinement.smallest = finest * first_size;
    if (mesh.hexahedra.empty())
      sizes = fem::refine(*last.mesh_error, last.eta2, refinement);
    else // a script's own mesh: all of it finer
      specification.mesh.size *= std::pow(refinement.error, 1. / (2. * fem::order_of_refinement));
  }
  result.frame = std::move(last.frame);
  return result;
}

} // namespace gestell::coupling
