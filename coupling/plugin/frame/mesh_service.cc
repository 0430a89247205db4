#include "coupling/plugin/mesh_service.h"

#include "coupling/algebra/openblas.h"
#include "coupling/factors/petsc_factor.h"
#include "coupling/plugin/frame/converge_mesh.h"
#include "coupling/plugin/frame/mesh_statement.h"
#include "coupling/plugin/frame/prestressed.h"
#include "coupling/reduction/parts/parted_frame.h"
#include "coupling/reduction/reduce_frame.h"
#include "fem/assembly/attached_masses.h"
#include "fem/mesh/curved_sides.h"
#include "fem/mesh/memory_estimate.h"
#include "fem/mesh/mesher.h"
#include "fem/recovery/raised_matrices.h"
#include "fem/values/number_text.h"

#include <algorithm>
#include <iostream>
#include <optional>

namespace gestell::coupling
{

namespace
{

std::string counted(std::size_t n, const std::string &thing)
{
  return std::to_string(n) + " " + thing + (n == 1 ? "" : "s");
}

std::vector<const fem::Face *> faces_of(const fem::InterfaceSpecification &interface,
                                        const fem::GeometryReport         &geometry)
{
  std::vector<const fem::Face *> faces;
  for (const std::string &surface : interface.surfaces)
    for (const fem::Face &face : geometry.faces)
      if (const auto &tags = geometry.surfaces.at(surface); std::count(tags.begin(), tags.end(), face.tag))
        faces.push_back(&face);
  return faces;
}

/// Centroid of faces, weighted by area; none for an interface at a node, which may have no surface.
std::optional<fem::Vector3> centroid_of(const std::vector<const fem::Face *> &faces)
{
  fem::Vector3 moment{};
  double       area = 0.;
  for (const fem::Face *face : faces)
  {
    area += face->area;
    for (int d = 0; d < 3; ++d)
      moment[d] += face->area * face->centre[d];
  }
  if (!(area > 0.))
    return std::nullopt;
  return fem::Vector3{moment[0] / area, moment[1] / area, moment[2] / area};
}

std::array<fem::Vector3, 2> box_of(const std::vector<const fem::Face *> &faces)
{
  std::array<fem::Vector3, 2> box{faces.front()->min, faces.front()->max};
  for (const fem::Face *face : faces)
    for (int d = 0; d < 3; ++d)
    {
      box[0][d] = std::min(box[0][d], face->min[d]);
      box[1][d] = std::max(box[1][d], face->max[d]);
    }
  return box;
}

/// Whether it takes its faces as a whole, not a place on them.
bool takes_faces(const fem::InterfaceSpecification &interface)
{
  return interface.coupling != fem::InterfaceCoupling::point && interface.coupling != fem::InterfaceCoupling::node;
}

double skin_of(const fem::Mesh &mesh)
{
  using fem::operator-;
  double     area = 0.;
  for (const auto &[a, b, c] : mesh.skin)
    area += 0.5 * fem::norm(fem::cross(mesh.points[b] - mesh.points[a], mesh.points[c] - mesh.points[a]));
  return area;
}

/// A frame in parts, and the memory that its reduction needs.
struct PartedMesh
{
  fem::CellParts parts;
  PartsMemory    memory;
};

/// In the number given, or the fewest parts that need about the least memory in any process; none where parts save
/// little.
std::optional<PartedMesh> parts_of(const fem::Discretisation &discretisation, const fem::Mesh &mesh,
                                   const fem::FrameSpecification &frame)
{
  const double kappa  = fem::compactness(fem::curved_volume(mesh), skin_of(mesh));
  const auto   parted = [&](int number)
  {
    fem::CellParts    parts  = discretisation.mesh_error->parts(number, frame.place);
    const PartsMemory memory = memory_of_parts(parts, discretisation.matrices, kappa);
    return PartedMesh{std::move(parts), memory};
  };
  if (frame.parts > 0)
    return parted(frame.parts);
  constexpr double          worth_cutting = 0.75, about_equal = 0.9; // shares of memory: each part costs time
  std::optional<PartedMesh> best;
  double limit = worth_cutting * fem::reduction_memory(double(discretisation.matrices.M.rows()), kappa);
  for (const int number : {2, 3, 4, 6, 8, 12})
  {
    if (number > mesh.n_cells())
      break;
    PartedMesh   next   = parted(number);
    const double memory = next.memory.largest_process();
    if (memory < limit)
    {
      limit = about_equal * memory;
      best.emplace(std::move(next));
    }
    else if (memory > 2. * limit)
      break; // the interface outgrows the parts
  }
  return best;
}

void add_mesh_statement(ReducedModel &reduced, const fem::Discretisation &of, const fem::Mesh &mesh,
                        const Progress &progress)
{
  if (progress)
    progress("mesh error", -1.);
  auto [text, warns] = mesh_statement(reduced, of.matrices, *of.mesh_error, mesh);
  (warns ? reduced.frame.notes : reduced.frame.statements).push_back(std::move(text));
}

/// @param keeps  M and C, which otherwise several ranks store during the reduction, and none after it.
MeshService::Unreduced assemble(const fem::Mesh &mesh, const fem::FrameSpecification &frame,
                                const ReductionOptions &options, const Progress &progress, bool keeps)
{
  fem::Discretisation discretisation = discretised(mesh, frame, options.factor, progress);
  fem::FrameMatrices &matrices       = discretisation.matrices;
  discretisation.geometric           = fem::SparseMatrix();
  keeps                              = keeps || may_be_raised(*discretisation.mesh_error, double(matrices.M.rows()));
  ReducedModel reduced               = reduce_with_basis(matrices, options, progress, keeps ? nullptr : &matrices);
  if (const auto &D = discretisation.balance; D.size() > 0)
    reduced.frame.C.topLeftCorner(D.rows(), D.cols()) -= D;
  add_mesh_statement(reduced, discretisation, mesh, progress);
  return {std::move(discretisation.matrices), std::move(reduced.frame)};
}

class PluginMeshService final : public MeshService
{
public:
  Inspection inspect(const fem::FrameSpecification &frame) override
  {
    fem::require_valid(frame.masses, frame.interfaces);
    const fem::GeometryReport geometry = fem::inspect_geometry(frame);
    Inspection result{counted(geometry.solids.size(), "solid") + ", " + rounded(geometry.volume) + " m^3",
                      geometry.notes,
                      geometry.statements,
                      {},
                      {},
                      fem::norm(fem::operator-(geometry.max, geometry.min)),
                      std::any_of(geometry.faces.begin(), geometry.faces.end(),
                                  [](const fem::Face &face) { return face.kind != fem::FaceKind::plane; })};
    for (const fem::InterfaceSpecification &interface : frame.interfaces)
    {
      const std::vector<const fem::Face *> faces = faces_of(interface, geometry);
      if (const auto centroid = centroid_of(faces))
        result.centroids[interface.name] = *centroid;
      if (!faces.empty() && takes_faces(interface))
        result.boxes[interface.name] = box_of(faces);
    }
    std::string between = "; surfaces: ";
    for (const auto &[name, faces] : geometry.surfaces)
    {
      result.found += between + name + " " + counted(faces.size(), "face");
      between = ", ";
    }
    return result;
  }

  ReducedFrame reduce(const fem::FrameSpecification &frame, const ReductionOptions &options,
                      const Progress &progress) override
  {
    use_one_blas_thread();
    const fem::Mesh mesh = fem::make_mesh(frame, progress);
    if (progress)
      progress("assembly", -1.);
    if (frame.parts == 1)
      return coupling::assemble(mesh, frame, options, progress, false).reduced;
    fem::Discretisation       discretisation = fem::discretise_for_parts(mesh, frame);
    std::optional<PartedMesh> parted         = parts_of(discretisation, mesh, frame);
    if (!parted)
      return coupling::assemble(mesh, frame, options, progress, false).reduced;
    if (const int ranks = ranks_of_factors().size(); ranks > 1)
      std::cerr << "gestell: ranks without work while the parts are reduced: " + std::to_string(ranks - 1) + " of " +
                       std::to_string(ranks) + '\n';
    use_blas_threads(1); // processes side by side instead: equal results for any number of them
    const double fitting = std::max(1., fem::available_memory() / parted->memory.part);
    PartsCall    call{frame.rayleigh_mass, frame.rayleigh_stiffness, frame.place,
                   int(std::min(fitting, double(jobs_requested()))), progress};
    if (frame.prestress)
      call.prestress = frame.prestress->place.empty() ? "prestress" : frame.prestress->place;
    ReducedModel reduced      = frame.prestress
                                    ? reduce_prestressed_in_parts(discretisation, parted->parts, mesh, frame, options, call)
                                    : reduce_in_parts(discretisation.matrices, parted->parts, options, call);
    discretisation.matrices.C = fem::SparseMatrix();
    add_mesh_statement(reduced, discretisation, mesh, progress);
    return std::move(reduced.frame);
  }

  Unreduced assemble(const fem::FrameSpecification &frame, const ReductionOptions &options,
                     const Progress &progress) override
  {
    use_one_blas_thread();
    const fem::Mesh mesh = fem::make_mesh(frame, progress);
    if (progress)
      progress("assembly", -1.);
    return coupling::assemble(mesh, frame, options, progress, true);
  }

  ReducedFrame reduce_raised(const fem::FrameSpecification &frame, const ReductionOptions &options,
                             const Progress &progress) override
  {
    use_one_blas_thread();
    const fem::Mesh          mesh   = fem::make_mesh(frame, progress);
    const fem::FrameMatrices raised = fem::raised_matrices(discretised(mesh, frame, options.factor, progress), frame);
    return reduce_frame(raised, options, progress);
  }

  MeshConvergence converge(const fem::FrameSpecification &frame, const ReductionOptions &reduction,
                           const ConvergenceOptions &options, const Progress &progress) override
  {
    use_one_blas_thread();
    return converge_mesh(frame, reduction, options, progress);
  }
};

} // namespace

} // namespace gestell::coupling

gestell::coupling::MeshService *gestell_mesh_service()
{
  static gestell::coupling::PluginMeshService service;
  return &service;
}
