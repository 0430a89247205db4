#pragma once

#include "fem/assembly/affine_constraints.h"
#include "fem/assembly/surface_patch.h"
#include "fem/values/frame_matrices.h"
#include "fem/values/frame_specification.h"

#include <Eigen/Geometry>

#include <vector>

namespace gestell::fem
{

/// A surface patch and its node with six DOFs; or a node of the mesh with three.
struct CoupledPatch
{
  InterfaceSpecification specification;
  SurfacePatch           patch;    ///< of InterfaceCoupling::node its one node, without faces
  Eigen::Vector3d        position; ///< x0 of the node [m]
  PlaneFace              face{};   ///< of the patch

  int n_motions() const { return specification.coupling == InterfaceCoupling::node ? 3 : 6; }
  int n_coordinates() const { return n_motions() + n_fields(face.degree); }
};

/**
 * Reduces the patch to the point of the surface nearest to the position, which moves there: to the triangles at the
 * nearest corner, or with a radius to those with the centroid inside. Under a concentrated force the deflection of a
 * continuum is unbounded as cells shrink; only a radius gives a flexibility independent of the mesh.
 *
 * @throws std::invalid_argument if no triangle is within the radius.
 */
void shrink_to_point(CoupledPatch &coupled, const QuadraticMesh &mesh);

/**
 * The corner of the mesh nearest to the requested position, on the named surfaces or on the whole skin; the first of
 * several equally near ones. Its three displacements are DOFs: no rotation, no averaging. Its flexibility has no limit
 * as cells shrink, see shrink_to_point().
 *
 * @throws std::invalid_argument without a position, and for unknown surfaces.
 */
CoupledPatch nearest_node(const InterfaceSpecification &interface, const Mesh &mesh, const QuadraticMesh &quadratic);

/// Warnings with the nodes and points of a surface farther than `tolerance` [m] from the requested position; points of
/// a surface only beyond a quarter of the width of the triangles around them.
std::vector<std::string> nodes_beside(const std::vector<CoupledPatch> &interfaces, double tolerance);

/// Box around the nodes of its faces.
Eigen::AlignedBox3d box_of(const CoupledPatch &coupled, const QuadraticMesh &mesh);

/// A note on every attached mass farther than `distance` [m] from its surface: probably a wrong unit.
std::vector<std::string> masses_far_off(const std::vector<CoupledPatch> &coupled, double distance);

/// Finds surfaces and positions; sets MultipointConstraints::n_interface_coordinates and their numbers among the new
/// values.
std::vector<CoupledPatch> couple_patches(const Mesh &mesh, const QuadraticMesh &quadratic,
                                         const std::vector<InterfaceSpecification> &interfaces,
                                         MultipointConstraints                     &constraints);

/**
 * Rigid coupling (RBE2): every node at x of the patch moves as  u = u0 + theta x (x - x0).
 *
 * @param first value number of the node's ux; ux uy uz rx ry rz follow.
 */
void tie_rigid(const CoupledPatch &coupled, const QuadraticMesh &mesh, int first, MultipointConstraints &constraints);

/**
 * Flexible face: every node at x of the patch moves as  u = u0 + theta x (x - x0) + sum_k a_k phi_k(x), see PlaneFace.
 *
 * Two faces with fields of one degree can be welded regardless of their meshes; between their nodes they coincide
 * within the interpolation error of the fields.
 */
void tie_flexible(const CoupledPatch &coupled, const QuadraticMesh &mesh, int first,
                  MultipointConstraints &constraints);

/**
 * Averaging coupling (RBE3): the node gets the rigid motion p = (u0, theta) of the least-squares fit to the surface,
 *
 *     int |u(x) - u0 - theta x (x - x0)|^2 dA -> min,     p = (R^T S R)^-1 R^T S u = W u,
 *
 * with the rigid motions R of the surface's nodes and S = int N N^T dA, both exact for quadratic triangles.  u0 is thus
 * the area-weighted mean (carried to x0), and a force on the node spreads as a traction linear over the surface; the
 * surface keeps its flexibility.  Six displacements are eliminated, chosen by pivoting.
 *
 * A large surface would give one dense block of all its displacements. It is therefore divided into groups g of nodes,
 * each with six inner coordinates  m_g = W_pg^-1 W_g u_g  (p: six pivots of the group) in place of u_pg; the average
 * becomes p = sum_g W_pg m_g, which eliminates six of the m_g. This is exact.
 */
void tie_average(const CoupledPatch &coupled, const QuadraticMesh &mesh, int first, MultipointConstraints &constraints);

/**
 * Ties all interfaces.
 *
 * @throws std::invalid_argument if two interfaces, or an interface and a clamped support, share nodes, and for surfaces
 * with all points on one line.
 */
void tie_interfaces(const std::vector<CoupledPatch> &interfaces, const QuadraticMesh &mesh,
                    MultipointConstraints &constraints);

} // namespace gestell::fem
