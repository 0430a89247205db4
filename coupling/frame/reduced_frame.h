#pragma once

#include "coupling/frame/reduced_stress.h"
#include "fem/values/frame_matrices.h"

#include <Eigen/Core>

#include <string>
#include <vector>

namespace gestell::coupling
{

/**
 * A frame in the coordinates p = (q1 [n1], modes [m]) of (5.5.3/15-20): small dense matrices and all data for a
 * simulation, including the rows for outputs and pictures.  Interfaces index into p; their coordinates come first.  A
 * small frame given by matrices has its other physical coordinates in place of modes.
 */
struct ReducedFrame
{
  Eigen::MatrixXd               M, B, C; // [(n1+m) x (n1+m)]
  int                           n_interface = 0;
  bool                          modal       = true; ///< modal coordinates follow the interface: M_LL = E, C_LL diagonal
  Eigen::VectorXd               omega0;             // [m] fixed-interface frequencies [rad/s]; empty if not modal
  std::vector<fem::Interface>   interfaces;
  Eigen::MatrixXd               translations_load; // [(n1+m) x 3]  T^T M R: load of a unit acceleration in x, y, z
  std::vector<fem::FrameOutput> outputs;           // rows on p

  // pictures
  std::vector<std::array<double, 3>> points;
  std::vector<std::array<int, 3>>    triangles;
  Eigen::MatrixXf                    displacement; // [3 points x (n1+m)]
  ReducedStress                      stress;

  // known properties of the model
  int             n_full        = 0; ///< DOFs of the unreduced frame
  int             n_cells       = 0;
  int             n_fixed_modes = 0;       ///< the other columns after the interface are static shapes
  double          mass          = 0.;      ///< [kg]
  fem::FrameFacts facts;                   ///< of a frame with finite elements
  Eigen::VectorXd frequencies_hz;          // [p] supported frame, interface free, from the reduced model
  double          frequency_limit_hz = 0.; ///< upper limit of validity of the model
  Eigen::VectorXd frequency_error;         // [p] estimated relative error of these, >= 0; NaN: unknown
  /// [n1 x n1] Psi^T M (C22^-1 - V22 diag(1/omega_0^2) V22^T) M Psi, sum of m_j m_j^T/omega_j^2 over the truncated
  /// fixed-interface modes, m_j their coupling masses; or empty: unknown. Static shapes of the basis are not included.
  Eigen::MatrixXd          left_out;
  double                   static_residual = 0.; ///< part of the static load on q2 missed by the modes, relative
  std::vector<std::string> notes;                ///< warnings of the reduction
  std::vector<std::string> statements;           ///< checks of the reduction without warning
  std::vector<std::string> cache_notes;          ///< from the cache of this computer; not stored in the file

  std::vector<std::string> all_notes() const
  {
    std::vector<std::string> all = notes;
    all.insert(all.end(), cache_notes.begin(), cache_notes.end());
    return all;
  }

  /// Number of rigid-body modes, as in the full frame.
  int n_rigid() const { return int((frequencies_hz.array() == 0.).count()); }
};

} // namespace gestell::coupling
