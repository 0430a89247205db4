#pragma once

#include "coupling/integration/system/turning_forces.h"
#include "coupling/machine/machine_parts.h"

#include <memory>
#include <string>
#include <vector>

namespace gestell::coupling
{

/// Frame, bodies and linear couplings.
class MachineLinear final : public LinearSystem
{
public:
  explicit MachineLinear(const MachineParts &parts) : parts_(parts) {}

  int                           size() const override;
  void                          mass_times(const Eigen::VectorXd &x, Eigen::VectorXd &y) const override;
  void                          damping_times(const Eigen::VectorXd &x, Eigen::VectorXd &y) const override;
  void                          stiffness_times(const Eigen::VectorXd &x, Eigen::VectorXd &y) const override;
  std::unique_ptr<LinearSolver> factorise(double w_M, double w_B, double w_C) const override;
  std::vector<SpectrumLine>     spectrum() const override;
  const Excitation             &excitation() const override;
  bool                    dense_matrices(Eigen::MatrixXd &M, Eigen::MatrixXd &B, Eigen::MatrixXd &C) const override;
  bool                    sparse_matrices(Eigen::SparseMatrix<double> &M, Eigen::SparseMatrix<double> &B,
                                          Eigen::SparseMatrix<double> &C) const override;
  const std::vector<int> &virtual_coordinates() const override;
  std::string             coordinate_name(int i) const override;

private:
  const MachineParts &parts_;
};

/// The nonlinear elements.
class MachineForces final : public LocalForces, public TurningForces
{
public:
  explicit MachineForces(const MachineParts &parts) : parts_(parts) {}

  const Eigen::SparseMatrix<double> &directions() const override;
  void                               force(const LocalState &state, Eigen::VectorXd &p) const override;
  void                    tangent(const LocalState &state, double w_u, double w_v, double w_a, Eigen::VectorXd &p,
                                  Eigen::MatrixXd &dp) const override;
  void                    derivatives(const LocalState &state, Eigen::VectorXd &p, Eigen::MatrixXd &dp_du,
                                      Eigen::MatrixXd &dp_dv) const override;
  void                    add_turning(const LocalState &state, Eigen::MatrixXd &dp_du) const override;
  std::vector<ForceBlock> blocks() const override;
  void tangent_blocks(const LocalState &state, double w_u, double w_v, double w_a, Eigen::VectorXd &p,
                      Eigen::VectorXd &blocks) const override;
  const std::vector<HeldMeasure> &held() const override;
  std::string                     element_of(int measure) const override;
  bool                            need_multipliers() const override;

private:
  const MachineParts &parts_;
};

class MachineJoints final : public IdealJoints, public TurningForces
{
public:
  explicit MachineJoints(const MachineParts &parts) : parts_(parts) {}

  const std::vector<ConstraintBlock> &blocks() const override;
  void        constraints(const LocalState &state, Eigen::VectorXd &g, ConstraintJacobian &G) const override;
  void        rates(const LocalState &state, Eigen::VectorXd &rate, Eigen::VectorXd &bias) const override;
  bool        depends(std::size_t b, int r, int k) const override;
  void        add_turning(const LocalState &state, Eigen::MatrixXd &dp_du) const override;
  bool        wants_multipliers() const override;
  std::string name(int i) const override;

private:
  void                   turn(const LocalState &state) const;
  mechanism::LocalMotion motion(const MachineParts::PlacedElement &part, const LocalState &state,
                                mechanism::Turn *turns) const;

  const MachineParts                  &parts_;
  mutable std::vector<mechanism::Turn> turns_; ///< of no turn, then of parts_.angles
};

/// History and guards of elements, joints and switches.
class MachineEvents final : public EventSystem
{
public:
  explicit MachineEvents(MachineParts &parts) : parts_(parts) {}

  void            follow_history(bool follow) override;
  Eigen::VectorXd save_history() const override;
  void            restore_history(const Eigen::VectorXd &saved) override;
  void            start(const LocalState &state) override;
  void            accept(const LocalState &state) override;
  int             n_guards() const override;
  void            guard_values(const LocalState &state, Eigen::VectorXd &g) const override;
  GuardCrossing   crossing(int i) const override;
  ActiveGuard     guard(int i) const override;
  void            transition(int i, const LocalState &state) override;

private:
  MachineParts &parts_;
};

class MachineEnergy final : public EnergyAccount
{
public:
  explicit MachineEnergy(const MachineParts &parts) : parts_(parts) {}

  double stored(const LocalState &state) const override;
  void   power(const LocalState &state, const Eigen::VectorXd &p, double &input, double &dissipated) const override;

private:
  const MachineParts &parts_;
};

/// The five parts of a machine as a SecondOrderSystem.
struct MachineSystem
{
  explicit MachineSystem(MachineParts &parts)
      : linear(parts), forces(parts), joints(parts), events(parts), energy(parts)
  {
  }

  MachineLinear linear;
  MachineForces forces;
  MachineJoints joints;
  MachineEvents events;
  MachineEnergy energy;
};

} // namespace gestell::coupling
