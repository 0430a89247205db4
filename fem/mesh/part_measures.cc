#include "fem/mesh/part_measures.h"

#include "fem/geometry/cad_file.h"
#include "fem/geometry/gmsh_session.h"
#include "fem/geometry/read_cad.h"
#include "fem/mesh/cell_measures.h"
#include "fem/mesh/mesh_extraction.h"
#include "fem/values/triangle_surface.h"
#include "fem/values/vector3.h"

#include <Eigen/Eigenvalues>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <gmsh.h>

#include <cmath>
#include <map>
#include <stdexcept>

namespace gestell::fem
{

namespace
{

/**
 * Integrals over a volume V of density one, about an origin that stays:
 *
 *     V = int dV,   first = int x dV,   second = int x x^T dV.
 *
 * Of a tetrahedron with corners x_i and s = sum x_i they are exact:  V s/4  and  V/20 (sum x_i x_i^T + s s^T).
 */
struct VolumeIntegrals
{
  double          volume = 0.;
  Eigen::Vector3d first  = Eigen::Vector3d::Zero();
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();

  /// Positively oriented corners add, others subtract: tetrahedra from one point to the triangles of a closed surface
  /// sum up to the volume it encloses.
  void add_tetrahedron(const Eigen::Vector3d &a, const Eigen::Vector3d &b, const Eigen::Vector3d &c,
                       const Eigen::Vector3d &d)
  {
    const double          V = (b - a).dot((c - a).cross(d - a)) / 6.;
    const Eigen::Vector3d s = a + b + c + d;
    volume += V;
    first += 0.25 * V * s;
    second +=
        V / 20. * (a * a.transpose() + b * b.transpose() + c * c.transpose() + d * d.transpose() + s * s.transpose());
  }

  /// A body of volume V, its centre, and its tensor of inertia about it, int (r.r I - r r^T) dV.
  void add_body(double V, const Eigen::Vector3d &centre, const Eigen::Matrix3d &inertia)
  {
    volume += V;
    first += V * centre;
    second += 0.5 * inertia.trace() * Eigen::Matrix3d::Identity() - inertia + V * centre * centre.transpose();
  }

  Eigen::Vector3d centre() const { return first / volume; }

  /// Tensor of inertia about the centre [m^5].
  Eigen::Matrix3d inertia() const
  {
    const Eigen::Matrix3d S = second - volume * centre() * centre().transpose();
    return S.trace() * Eigen::Matrix3d::Identity() - S;
  }
};

std::string head_of(const CadSource &source)
{
  return source.place + ": " + source.path;
}

Eigen::Vector3d vector(const Vector3 &x)
{
  return {x[0], x[1], x[2]};
}

/// The triangles of these surfaces of gmsh's mesh.
TriangleSurface surface_of(const std::vector<int> &tags, double unit)
{
  TriangleSurface            surface;
  std::map<std::size_t, int> index;
  for (const int tag : tags)
  {
    std::vector<std::size_t> nodes;
    std::vector<double>      x, parameters;
    gmsh::model::mesh::getNodesByElementType(2, nodes, x, parameters, tag, false); // 2: triangles of three nodes
    for (std::size_t i = 0; i < nodes.size(); i += 3)
    {
      std::array<int, 3> triangle;
      for (int k = 0; k < 3; ++k)
      {
        const auto [entry, is_new] = index.try_emplace(nodes[i + k], static_cast<int>(surface.points.size()));
        triangle[k]                = entry->second;
        if (is_new)
          surface.points.push_back(unit * Vector3{x[3 * (i + k)], x[3 * (i + k) + 1], x[3 * (i + k) + 2]});
      }
      surface.triangles.push_back(triangle);
    }
  }
  return surface;
}

void add_skin(CadBody &part, const TriangleSurface &surface)
{
  const int first = static_cast<int>(part.points.size());
  part.points.insert(part.points.end(), surface.points.begin(), surface.points.end());
  for (const auto &[a, b, c] : surface.triangles)
    part.triangles.push_back({first + a, first + b, first + c});
}

/// Coarse triangles for pictures, solid by solid; none if gmsh does not find them.
void draw_skin(CadBody &part, const CadModel &model)
{
  constexpr double coarsest = 0.2; // edge of a skin's triangles by the part's diagonal
  gmsh::option::setNumber("Mesh.MeshSizeMax", coarsest * model.diagonal() / model.unit);
  constexpr int n_around = 16; // edges around a full circle: its area is 2.6 % small
  gmsh::option::setNumber("Mesh.MeshSizeFromCurvature", n_around);
  try
  {
    gmsh::model::mesh::generate(2);
    for (const Solid &solid : model.solids)
    {
      TriangleSurface surface = surface_of(solid.faces, model.unit);
      turn_outwards(surface);
      // share of the volume inside a coarse skin, which cuts corners; an open skin encloses any volume
      constexpr double enclosed_share = 0.5;
      const bool closed = unmatched_edges(surface) == 0 && enclosed_volume(surface) > enclosed_share * solid.volume;
      if (!closed)
        throw std::runtime_error("the skin is open");
      add_skin(part, surface);
    }
  }
  catch (...) // gmsh throws integers and texts: a body without a picture is one all the same
  {
    part.points.clear();
    part.triangles.clear();
  }
}

/// Boolean union, for solids whose boxes touch: overlapping ones would count twice.
void check_overlap(const CadModel &model, const CadSource &source, const GmshSession &session)
{
  bool touch = false;
  for (std::size_t i = 0; i < model.solids.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      touch |= boxes_touch(model.solids[i], model.solids[j], 0.);
  if (!touch)
    return;
  gmsh::vectorpair first = {{3, model.solids[0].tag}}, rest, united;
  for (std::size_t i = 1; i < model.solids.size(); ++i)
    rest.emplace_back(3, model.solids[i].tag);
  std::vector<gmsh::vectorpair> parents;
  session.run([&] { gmsh::model::occ::fuse(first, rest, united, parents); },
              head_of(source) + ": gmsh cannot determine whether its solids overlap: ",
              "; unite them into one solid in the CAD program.");
  double volume = 0.;
  for (const auto &[dim, tag] : united)
  {
    double V = 0.;
    gmsh::model::occ::getMass(dim, tag, V);
    volume += V * std::pow(model.unit, 3);
  }
  // relative, of a union against its solids: rounding of OpenCASCADE's integrals
  constexpr double same_volume = 1e-6;
  if (volume < (1. - same_volume) * model.volume())
    throw std::invalid_argument(
        head_of(source) + ": its " + std::to_string(model.solids.size()) + " solids overlap: they have " +
        text(model.volume()) + " m^3 in sum and " + text(volume) +
        " m^3 united; unite them into one solid in the CAD program, otherwise their common part counts twice.");
}

void measure_geometry(CadBody &part, VolumeIntegrals &sum, const CadModel &model, const CadSource &source,
                      const GmshSession &session)
{
  const double unit = model.unit;
  for (const Solid &solid : model.solids)
  {
    Vector3             centre;
    std::vector<double> J;
    gmsh::model::occ::getCenterOfMass(3, solid.tag, centre[0], centre[1], centre[2]);
    gmsh::model::occ::getMatrixOfInertia(3, solid.tag, J); // about the solid's centre of mass
    sum.add_body(solid.volume, unit * vector(centre), std::pow(unit, 5) * Eigen::Map<const Eigen::Matrix3d>(J.data()));
    part.solids.push_back(solid.name);
  }
  draw_skin(part, model);
  check_overlap(model, source, session);
}

void measure_cells(CadBody &part, VolumeIntegrals &sum, const CadModel &model, const CadSource &source)
{
  const Mesh mesh = extract_mesh(model, head_of(source), {0}).mesh;
  for (const auto &[a, b, c, d] : tetrahedra_of(mesh))
    sum.add_tetrahedron(vector(mesh.points[a]), vector(mesh.points[b]), vector(mesh.points[c]), vector(mesh.points[d]));
  part.solids = mesh.solids;
  add_skin(part, {mesh.points, mesh.skin});
}

void measure_triangles(CadBody &part, VolumeIntegrals &sum, const CadModel &model, const CadSource &source)
{
  gmsh::vectorpair surfaces;
  gmsh::model::getEntities(surfaces, 2);
  std::vector<int> tags;
  for (const auto &[dim, tag] : surfaces)
    tags.push_back(tag);
  TriangleSurface surface = surface_of(tags, model.unit);
  if (surface.triangles.empty())
    throw std::invalid_argument(head_of(source) + " contains no triangles; export the part again.");
  if (const int open = unmatched_edges(surface))
    throw std::invalid_argument(
        head_of(source) + " is not a closed surface: at " + std::to_string(open) + " of its " +
        std::to_string(surface.triangles.size()) +
        " edges of triangles the neighbour is missing; close the holes, or export the part as STEP.");
  if (enclosed_volume(surface) < 0.)
    for (auto &triangle : surface.triangles)
      std::swap(triangle[1], triangle[2]);
  const Eigen::Vector3d inside =
      vector(0.5 * (model.min + model.max)); // near the part: of volume and centre no digits are lost
  for (const auto &[a, b, c] : surface.triangles)
    sum.add_tetrahedron(inside, vector(surface.points[a]), vector(surface.points[b]), vector(surface.points[c]));
  part.solids = {"surface"};
  add_skin(part, surface);
}

/// Moments about the centre are left of those about the origin, which are larger by the square of the distance.
void require_near(const VolumeIntegrals &sum, const CadModel &model, const CadSource &source)
{
  constexpr double farthest = 1e4; // from the origin by the diagonal: some 1e-6 is lost of inertia
  if (const double distance = sum.centre().norm(); distance > farthest * model.diagonal())
    throw std::invalid_argument(head_of(source) + " is " + text(model.diagonal()) + " m across and is " +
                                text(distance) +
                                " m from the origin, where its moments of inertia lose their digits; move it closer to "
                                "the origin in the CAD program.");
}

/// Requires second moments of the volume about its centre, tr(J)/2 I - J, that are positive semidefinite.
void require_inertia_of_a_body(const Eigen::Matrix3d &J, const CadSource &source)
{
  const Eigen::Vector3d principal =
      J.allFinite() ? Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(J).eigenvalues() : Eigen::Vector3d::Constant(NAN);
  const double smallest = 0.5 * principal.sum() - principal[2];
  // of the largest moment: 1e-16 times the square of `farthest`, times some tens of slender bodies
  constexpr double rounding_of_inertia = 1e-5;
  if (!(smallest >= -rounding_of_inertia * principal.cwiseAbs().maxCoeff()))
    throw std::invalid_argument(head_of(source) + " has impossible principal moments of inertia (" +
                                text(principal[0]) + ", " + text(principal[1]) + ", " + text(principal[2]) +
                                " m^5): a face of it is open or turned inside out; repair it in the CAD program.");
}

} // namespace

CadBody measures_of_part(const CadSource &source)
{
  const GmshSession session;
  CadBody           part;
  const auto        measure = [&]
  {
    const CadFile file = check_cad_file(source);
    if (file == CadFile::triangles && !(source.unit > 0.))
      throw std::invalid_argument(head_of(source) + " contains no unit; give it, such as unit = \"1 mm\".");
    const CadModel  model = open_cad(source, session);
    VolumeIntegrals sum;
    if (file == CadFile::triangles)
      measure_triangles(part, sum, model, source);
    else if (is_mesh(file))
      measure_cells(part, sum, model, source);
    else
      measure_geometry(part, sum, model, source, session);
    if (!(sum.volume > 0.))
      throw std::invalid_argument(head_of(source) + " has a volume of " + text(sum.volume) +
                                  " m^3; repair it in the CAD program.");
    part.volume  = sum.volume;
    part.centre  = sum.centre();
    part.inertia = sum.inertia();
    require_near(sum, model, source);
    require_inertia_of_a_body(part.inertia, source);
  };
  session.run(measure, head_of(source) + ": gmsh fails on this part: ", "; repair it, or export it another way.");
  return part;
}

} // namespace gestell::fem
