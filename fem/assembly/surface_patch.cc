#include "fem/assembly/surface_patch.h"

#include "fem/assembly/face_rules.h"
#include "fem/values/nearest_name.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <set>
#include <stdexcept>

namespace gestell::fem
{

namespace
{

std::string head(const std::string &place, const std::string &owner)
{
  return place.empty() ? owner : place + ": " + owner;
}

std::set<int> triangles_of(const Mesh &mesh, const std::vector<std::string> &surfaces, const std::string &head)
{
  if (surfaces.empty())
    throw std::invalid_argument(head + " names no surface; give at least one.");
  std::vector<std::string> known;
  for (const auto &entry : mesh.surfaces)
    known.push_back(entry.first);

  std::set<int> triangles;
  for (const std::string &name : surfaces)
  {
    const auto surface = mesh.surfaces.find(name);
    if (surface == mesh.surfaces.end())
      throw std::invalid_argument(head + " names the surface \"" + name + "\", which does not exist in the frame; " +
                                  nearest_names(name, known) + ".");
    if (surface->second.empty())
      throw std::invalid_argument(head + ": the surface \"" + name +
                                  "\" has no triangle; select a face of the skin or mesh finer.");
    triangles.insert(surface->second.begin(), surface->second.end());
  }
  return triangles;
}

/// Area, int x dA, int N_a N_b dA and int N_a n dA of a face of n nodes.
template <int n>
struct FaceIntegrals
{
  double                      area   = 0.;
  Eigen::Vector3d             moment = Eigen::Vector3d::Zero();
  Eigen::Matrix<double, n, n> mass   = Eigen::Matrix<double, n, n>::Zero();
  Eigen::Matrix<double, 3, n> normal = Eigen::Matrix<double, 3, n>::Zero();
};

template <std::size_t n>
FaceIntegrals<int(n)> integrals(const QuadraticMesh &mesh, const std::array<int, n> &face,
                                const std::vector<FacePoint<int(n)>> &rule)
{
  Eigen::Matrix<double, 3, int(n)> X;
  for (std::size_t a = 0; a < n; ++a)
    X.col(a) = Eigen::Map<const Eigen::Vector3d>(mesh.points[face[a]].data());
  FaceIntegrals<int(n)> result;
  for (const auto &point : rule)
  {
    const Eigen::Matrix<double, 3, 2> tangents = X * point.dN;
    const Eigen::Vector3d             normal = Eigen::Vector3d(tangents.col(0)).cross(Eigen::Vector3d(tangents.col(1)));
    const double                      dA     = point.weight * normal.norm();
    result.area += dA;
    result.moment += dA * X * point.N;
    result.mass += dA * point.N * point.N.transpose();
    result.normal += point.weight * normal * point.N.transpose();
  }
  result.mass = 0.5 * (result.mass + result.mass.transpose()).eval(); // symmetric to the last bit
  return result;
}

double triangle_area(const QuadraticMesh &mesh, const std::array<int, 6> &face)
{
  const auto corner = [&](int k) { return Eigen::Map<const Eigen::Vector3d>(mesh.points[face[k]].data()); };
  return 0.5 * (corner(1) - corner(0)).cross(corner(2) - corner(0)).norm();
}

constexpr std::size_t centre = 8; // of a quadrilateral among its nodes

/// The quadrilaterals whose halves are given, each once.
std::vector<std::array<int, 9>> quads_of(const QuadraticMesh &mesh, const std::vector<std::array<int, 6>> &halves)
{
  std::vector<std::array<int, 9>> quads;
  if (mesh.skin_quads.empty())
    return quads;
  std::set<int> nodes; // the midst of a quadrilateral is the middle of the diagonal of its halves
  for (const std::array<int, 6> &half : halves)
    nodes.insert(half.begin() + 3, half.end());
  for (const std::array<int, 9> &quad : mesh.skin_quads)
    if (nodes.count(quad[centre]) > 0)
      quads.push_back(quad);
  return quads;
}

} // namespace

SurfacePatch surface_patch(const QuadraticMesh &mesh, std::vector<std::array<int, 6>> faces)
{
  SurfacePatch  patch;
  std::set<int> nodes;
  for (const std::array<int, 6> &face : faces)
    nodes.insert(face.begin(), face.end());
  patch.quads = quads_of(mesh, faces);
  std::set<int> centres;
  for (const std::array<int, 9> &quad : patch.quads)
  {
    nodes.insert(quad.begin(), quad.end());
    centres.insert(quad[centre]);
  }
  const auto is_half = [&](const std::array<int, 6> &face)
  { return std::any_of(face.begin() + 3, face.end(), [&](int node) { return centres.count(node) > 0; }); };
  patch.faces = std::move(faces);
  patch.nodes.assign(nodes.begin(), nodes.end());
  const auto local = [&](int node)
  { return static_cast<int>(std::lower_bound(patch.nodes.begin(), patch.nodes.end(), node) - patch.nodes.begin()); };

  std::vector<Eigen::Triplet<double>> entries;
  patch.normal   = Eigen::Matrix3Xd::Zero(3, Eigen::Index(patch.nodes.size()));
  const auto add = [&](const auto &face, const auto &of)
  {
    for (std::size_t a = 0; a < face.size(); ++a)
    {
      patch.normal.col(local(face[a])) += of.normal.col(Eigen::Index(a));
      for (std::size_t b = 0; b < face.size(); ++b)
        entries.emplace_back(local(face[a]), local(face[b]), of.mass(a, b));
    }
  };
  for (const std::array<int, 6> &face : patch.faces)
  {
    if (is_half(face))
    {
      const double area = triangle_area(mesh, face);
      patch.area += area;
      for (int k = 0; k < 3; ++k)
        patch.centroid += area / 3. * Eigen::Map<const Eigen::Vector3d>(mesh.points[face[k]].data());
      continue;
    }
    const auto triangle = integrals(mesh, face, face_rules().triangle);
    patch.area += triangle.area;
    patch.centroid += triangle.moment;
    add(face, triangle);
  }
  for (const std::array<int, 9> &quad : patch.quads)
    add(quad, integrals(mesh, quad, face_rules().quadrilateral));
  patch.centroid /= patch.area;
  patch.S.resize(patch.nodes.size(), patch.nodes.size());
  patch.S.setFromTriplets(entries.begin(), entries.end());
  patch.weight = patch.S * Eigen::VectorXd::Ones(patch.nodes.size());
  return patch;
}

SurfacePatch surface_patch(const Mesh &mesh, const QuadraticMesh &quadratic, const std::vector<std::string> &surfaces,
                           const std::string &owner, const std::string &place)
{
  std::vector<std::array<int, 6>> faces;
  for (const int triangle : triangles_of(mesh, surfaces, head(place, owner)))
    faces.push_back(quadratic.skin.at(triangle));
  SurfacePatch patch = surface_patch(quadratic, std::move(faces));
  if (!(patch.area > 0.))
    throw std::invalid_argument(head(place, owner) + ": the surfaces have no area; select faces of a solid.");
  return patch;
}

} // namespace gestell::fem
