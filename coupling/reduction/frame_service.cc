#include "coupling/frame_service.h"

#include "coupling/reduction/craig_bampton.h"
#include "coupling/reduction/openblas.h"
#include "coupling/reduction/team_assembly.h"
#include "fem/discretisation.h"
#include "fem/mesher.h"

#include <algorithm>

namespace gestell::coupling
{

namespace
{

/// Names a face bears: in the CAD file, then those the specification gives it.
std::string names_of(const fem::Face &face, const std::map<std::string, std::vector<int>> &surfaces)
{
  std::string names = face.name;
  for (const auto &[name, tags] : surfaces)
    if (std::find(tags.begin(), tags.end(), face.tag) != tags.end())
      names += (names.empty() ? "" : ", ") + name;
  return names;
}

/// The face as a selector would find it.
std::string shape_of(const fem::Face &face)
{
  switch (face.kind)
  {
  case fem::FaceKind::plane:
    return "plane, normal " + fem::text(face.direction) + ", through " + fem::text(face.through);
  case fem::FaceKind::cylinder:
    return "cylinder, axis " + fem::text(face.direction) + ", through " + fem::text(face.through) + ", radius " +
           fem::text(face.radius);
  case fem::FaceKind::other:
    break;
  }
  return face.type;
}

MeshReport report_of(const fem::GeometryReport &geometry, const fem::FrameSpecification &frame)
{
  MeshReport report;
  report.n_points      = geometry.n_points;
  report.n_cells       = geometry.n_cells;
  report.n_coordinates = geometry.n_coordinates;
  report.volume        = geometry.volume;
  report.mass          = geometry.volume * frame.material.rho;
  report.worst_quality = geometry.worst_quality;
  for (const auto &solid : geometry.solids)
    report.solids.push_back(solid.name);
  for (const auto &face : geometry.faces)
    report.surfaces.push_back(
        {face.tag, names_of(face, geometry.surfaces), shape_of(face), face.area, face.min, face.max, face.centre});
  return report;
}

class Service final : public FrameService
{
public:
  MeshReport mesh(const fem::FrameSpecification &frame, const Progress &progress) override
  {
    return report_of(fem::report_geometry(frame, progress), frame);
  }

  fem::Part measure(const fem::CadSource &part) override { return fem::measure_part(part); }

  fem::FrameMatrices assemble(const fem::FrameSpecification &frame, const Progress &progress) override
  {
    use_one_blas_thread();
    const fem::Mesh mesh = fem::make_mesh(frame, progress);
    if (progress)
      progress("assembly", -1.);
    return fem::discretise(mesh, frame, team_assembly());
  }

  ReducedFrame reduce(const fem::FrameMatrices &frame, const ReductionOptions &options,
                      const Progress &progress) override
  {
    use_one_blas_thread();
    return craig_bampton(frame, options, progress);
  }

  void add_modal_damping(fem::FrameMatrices &frame, int n_modes, const Progress &progress) override
  {
    use_one_blas_thread();
    coupling::add_modal_damping(frame, n_modes, progress);
  }
};

} // namespace

} // namespace gestell::coupling

gestell::coupling::FrameService *gestell_frame_service()
{
  static gestell::coupling::Service service;
  return &service;
}
