#pragma once

#include "fem/values/face_fields.h"
#include "fem/values/mass_properties.h"
#include "fem/values/modal_ratios.h"
#include "fem/values/sparse_matrix.h"
#include "fem/values/stress_recovery.h"

#include <Eigen/Core>

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace gestell::fem
{

/// The six DOFs of an interface node, in this order.
enum Motion
{
  ux,
  uy,
  uz,
  rx,
  ry,
  rz
};

/// DOFs of one interface node in q: DOF i is sign[i] * q[coordinate[i]], or fixed if -1; the rotations of a mesh node
/// are -1.
struct Interface
{
  std::string           name;
  std::array<double, 3> position{}; ///< [m]
  std::array<int, 6>    coordinate{-1, -1, -1, -1, -1, -1};
  std::array<double, 6> sign{1., 1., 1., 1., 1., 1.};
  PlaneFace             face{}; ///< of its surfaces, and the coordinates of fields over them

  /// All its coordinates in q: free DOFs of the node, then fields.
  std::vector<int> coordinates() const;
  /// Renumbers them: i becomes renamed(i).
  template <typename Renamed>
  void renumber(const Renamed &renamed)
  {
    for (int &i : coordinate)
      i = i < 0 ? -1 : renamed(i);
    for (int &i : face.coordinate)
      i = renamed(i);
  }
};

/// A force output of the frame:  on_q . q + on_v . q' + on_a . q'' + under_acceleration . g + constant.
struct FrameOutput
{
  std::string     name; ///< "cut.columns", "support.feet"
  std::string     unit; ///< "N"
  Eigen::VectorXd on_q; // [n]
  Eigen::VectorXd on_v; // [n]
  /// [kg] direct share of a uniform acceleration field g, such as gravity: weight on a support without motion of q, and
  /// the static deflection outside the basis of a reduced frame.
  Eigen::Vector3d under_acceleration = Eigen::Vector3d::Zero();
  Eigen::VectorXd on_a{};        ///< [n], or empty: none. For forces in joints, which include inertia next to them
  double          constant = 0.; ///< of the frame at q = 0, such as the prestress of a tie rod
};

/// Skin of the frame for pictures: displacement of point i, direction d is row 3 i + d of `displacement` times q.
struct Picture
{
  std::vector<std::array<double, 3>>           points;       ///< [m]
  std::vector<std::array<int, 3>>              triangles;    // into points
  Eigen::SparseMatrix<double, Eigen::RowMajor> displacement; // [3 points x n]
};

/// Modal damping as an operator of low rank: B = Z diag(d) Z^T with Z = M Phi [n x p], d = 2 zeta omega [p].
struct ModalDamping
{
  Eigen::MatrixXd Z;
  Eigen::VectorXd d;
};

/// Mass of a meshed frame and strain energy of its rigid-body modes, for reports.
struct FrameFacts
{
  struct SolidMass
  {
    std::string name, material; ///< of a solid; an attached mass has no material
    double      mass = 0.;      ///< [kg]
  };
  std::vector<SolidMass> parts;
  MassProperties         whole;
  /// Largest strain energy of the six rigid-body modes away from the supports, relative to the energies that cancel
  /// in it: rounding (about 1e-15) unless a cell, a coupling or a sum is wrong; nan if unknown.
  double rigid_energy = std::numeric_limits<double>::quiet_NaN();
  /// Names of the rigid-body modes of the supported frame (no elastic energy); see free_motions().
  std::vector<std::string> free_motions;
  /// Smallest positive factor of the loads of FrameSpecification::prestress at which the frame buckles, or its least
  /// known upper bound; infinite: none. Not set without prestress.
  std::optional<double> buckling_factor;
};

/**
 * A linear frame M q'' + B q' + C q = f, the interface between fem and coupling.
 *
 * Fixed DOFs are removed and coupled surfaces eliminated: M is positive (semi)definite, B and C are
 * symmetric and positive semidefinite; both triangles are stored.
 */
struct FrameMatrices
{
  SparseMatrix           M, B, C;             // [n x n] kg, N s/m, N/m
  ModalRatios            modal_damping_ratio; ///< zeta of the modes of the supported frame
  ModalDamping           modal_damping;       ///< empty until computed
  std::vector<Interface> interfaces;
  Eigen::MatrixXd        translations; // [n x 3] q of a unit translation of the whole frame in x, y, z
  /// [n x 3] load of a unit acceleration field (gravity); M * translations, exact also if supports are clamped.  Empty
  /// in frames given by matrices: then M * translations.
  Eigen::MatrixXd acceleration_load;
  /// [n x 6] q of the rigid-body modes ux uy uz rx ry rz about `centre`, or empty if unknown.
  Eigen::MatrixXd          rigid_motions;
  std::array<double, 3>    centre{}; ///< of mass [m]
  std::vector<FrameOutput> outputs;
  Picture                  picture;
  FrameFacts               facts;
  double                   mass = 0.; ///< of the frame with attached masses [kg]
  StressRecovery           stress;    ///< empty unless requested
  int                      n_cells = 0;
  std::vector<std::string> notes;      ///< warnings about geometry, mesh and assembly
  std::vector<std::string> statements; ///< results without warning

  /// Coordinates q1 of all interfaces, ascending.
  std::vector<int> interface_coordinates() const;
};

} // namespace gestell::fem
