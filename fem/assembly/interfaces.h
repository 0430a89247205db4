#pragma once

#include "fem/assembly/affine_constraints.h"
#include "fem/assembly/surface_patch.h"
#include "fem/values/frame_matrices.h"
#include "fem/values/frame_specification.h"

#include <Eigen/Geometry>

#include <vector>

namespace gestell::fem
{

/// A surface patch and the node with six coordinates it is coupled to; or a node of the mesh, which has three.
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
 * Cuts the patch down to the point of the surface nearest to the position, which moves there: to the triangles that
 * meet at the corner nearest to it, or with a radius to those whose centroid lies within it.
 *
 * A concentrated force bends a continuum without bound as cells shrink; only a radius gives a flexibility that does not
 * depend on the mesh.
 *
 * @throws std::invalid_argument if no triangle lies within the radius.
 */
void shrink_to_point(CoupledPatch &coupled, const QuadraticMesh &mesh);

/**
 * The corner of the mesh nearest to the position that is asked for, on the named surfaces or on the whole skin; of
 * several that are equally near the first.
 *
 * Its three displacements are coordinates as they are: no rotation, nothing averaged.  A force on it has no finite
 * flexibility as cells shrink, see shrink_to_point().
 *
 * @throws std::invalid_argument without a position, and for unknown surfaces.
 */
CoupledPatch nearest_node(const InterfaceSpecification &interface, const Mesh &mesh, const QuadraticMesh &quadratic);

/// Warnings that list nodes and points of a surface farther than `tolerance` [m] from the requested position; points of
/// a surface only beyond a quarter of the width of the triangles around them.
std::vector<std::string> nodes_beside(const std::vector<CoupledPatch> &interfaces, double tolerance);

/// Box around the nodes of its faces.
Eigen::AlignedBox3d box_of(const CoupledPatch &coupled, const QuadraticMesh &mesh);

/// A note on every attached mass farther than `distance` [m] from its surface: a unit mistaken?
std::vector<std::string> masses_far_off(const std::vector<CoupledPatch> &coupled, double distance);

/// Finds surfaces and positions; sets MultipointConstraints::n_interface_coordinates and their places among the new
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
 * Two faces with fields of one degree can be made to move alike whatever their meshes; between their nodes they move
 * alike to what the mesh can follow of the fields.
 */
void tie_flexible(const CoupledPatch &coupled, const QuadraticMesh &mesh, int first,
                  MultipointConstraints &constraints);

/**
 * Averaging coupling (RBE3): the node takes the rigid motion p = (u0, theta) that fits the surface best,
 *
 *     int |u(x) - u0 - theta x (x - x0)|^2 dA -> min,     p = (R^T S R)^-1 R^T S u = W u,
 *
 * with the rigid motions R of the surface's nodes and S = int N N^T dA, both exact for quadratic triangles.  u0 is thus
 * the area-weighted mean (carried to x0), and a force on the node spreads as a traction linear over the surface; the
 * surface keeps its flexibility.  Six displacements are eliminated, chosen by pivoting.
 *
 * A large surface would make one dense block of all its displacements.  It is therefore cut into groups g of nodes,
 * each with six inner coordinates  m_g = W_pg^-1 W_g u_g  (p: six pivots of the group) in place of u_pg; the average
 * becomes p = sum_g W_pg m_g, which eliminates six of the m_g.  Nothing is approximated.
 */
void tie_average(const CoupledPatch &coupled, const QuadraticMesh &mesh, int first, MultipointConstraints &constraints);

/**
 * Ties all interfaces.
 *
 * @throws std::invalid_argument where two interfaces, or an interface and a clamped support, share nodes, and for
 *         surfaces whose points lie on one line.
 */
void tie_interfaces(const std::vector<CoupledPatch> &interfaces, const QuadraticMesh &mesh,
                    MultipointConstraints &constraints);

} // namespace gestell::fem
