#pragma once

#include "coupling/integration/system/second_order_system.h"
#include "coupling/periodic/periodic_method.h"

#include <Eigen/Core>

#include <string>
#include <vector>

namespace gestell::coupling
{

/// A linear function f of the angles [1 x angles] on which a force, the stiffness or a joint depends.
struct AngleDependence
{
  Eigen::RowVectorXd of;
  int                turns = 0; ///< the equations repeat after this number of revolutions of f; 0: never
  std::string        element;   ///< whose law it is
};

/**
 * The shifts of some angles that do not change any equation of a system.
 *
 * Found from the equations: the rows of dp/du W^T, of dg/du W^T of the joints and of C, at states about one that is
 * given, span the functions f of the angles on which anything depends; a shift along their common null space is free.
 * Whether the equations repeat after whole turns of an f shows in p and g themselves at shifted states.
 */
class AngleInvariance
{
public:
  /// @param angles  coordinates [rad]
  /// @param about   q, q' [n] at `t`, about which the system is examined
  AngleInvariance(SecondOrderSystem &system, std::vector<int> angles, const PeriodicGuess &about, double t);

  const std::vector<int>             &angles() const { return angles_; }
  const std::vector<AngleDependence> &dependences() const { return dependences_; }
  /// Orthonormal shifts of the coordinates [n x k] on which nothing depends.
  Eigen::MatrixXd free() const;
  /// The element whose force or joint a shift of the angles changes; empty: none.
  std::string changed_by(const Eigen::VectorXd &shift) const;
  /// The nearest to x [angles], in the mass of each, whose f_k x is values[k] for all dependences, or for those that
  /// never repeat alone.
  Eigen::VectorXd nearest(const Eigen::VectorXd &x, const Eigen::VectorXd &values, bool never_repeating = false) const;

private:
  struct Law
  {
    int             first, n; ///< in the vector of all forces and joints
    std::string     name;
    Eigen::MatrixXd rows;   ///< those of the angles on which it depends [k x angles], reduced row echelon form
    bool            driven; ///< a joint that gives a function of the angles over the time, which may go any way
  };

  void            gather_laws();
  void            find_driven();
  void            look_at_laws();
  void            look_at_stiffness();
  void            make_samples(const PeriodicGuess &about, double t);
  Eigen::VectorXd laws_at(LocalState state) const;
  bool            changes(const Law &law, const Eigen::VectorXd &shift) const;
  bool            changes(const Law &law, const Eigen::VectorXd &before, const Eigen::VectorXd &after) const;

  SecondOrderSystem           &system_;
  std::vector<int>             angles_;
  int                          n_, n_u_;
  Eigen::MatrixXd              to_measures_; ///< du of the angles [n_u x angles]
  Eigen::VectorXd              mass_;        ///< [angles]
  std::vector<Law>             laws_;
  std::vector<LocalState>      samples_;
  std::vector<Eigen::VectorXd> at_samples_; ///< forces and joints there
  std::vector<AngleDependence> dependences_;
};

/// Name of the coordinate that moves most in the first free shift of a problem.
std::string free_coordinate(const PeriodicProblem &problem);

/// Of `free`, the shifts that leave a coordinate alone.
Eigen::MatrixXd without_coordinate(const Eigen::MatrixXd &free, int coordinate);

} // namespace gestell::coupling
