#pragma once

#include "apps/output/values/answer.h"
#include "apps/output/values/periodic_result.h"
#include "apps/output/values/run_story.h"
#include "apps/output/values/scenery.h"
#include "apps/output/values/size_result.h"
#include "apps/output/values/stress_result.h"
#include "coupling/modes/energy_shares.h"
#include "coupling/modes/modes.h"
#include "coupling/simulation/simulation.h"
#include "fem/values/frame_matrices.h"

#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace gestell::apps
{

/// What is known about the size and the accuracy of the model.  Counts below zero and nan mean: does not apply.
struct ModelFacts
{
  int dofs       = -1; ///< coordinates the integrator works with
  int interface  = -1; ///< coordinates q1 of the frame that stay physical
  int modes      = -1; ///< kept internal modes of the frame
  int nonlinear  = -1; ///< measures of the nonlinear elements, the size of a Newton step
  int frame_dofs = -1; ///< coordinates of the unreduced frame
  int superposed = -1; ///< coordinates of frame and mechanism that modes stand for
  int cells      = -1; ///< finite elements

  double frame_mass      = std::numeric_limits<double>::quiet_NaN(); ///< [kg]
  double frequency_error = std::numeric_limits<double>::quiet_NaN(); ///< largest estimated relative error by reduction
  double static_residual = std::numeric_limits<double>::quiet_NaN(); ///< see coupling::ReducedFrame
  double frequency_limit =
      std::numeric_limits<double>::quiet_NaN(); ///< [Hz] up to which a reduced frame is meant to hold

  fem::FrameFacts frame;            ///< of a frame made of cells
  int             free_motions = 0; ///< modes of the frame of frequency zero
  std::string     damping;          ///< of the frame, for people
  std::string
      mesh; ///< what nobody knows of the frame's mesh, for people; else its error is told by a statement or a warning
  std::vector<std::string> statements; ///< what was checked of the frame and is as it should be
};

/// What the computation was asked for.
struct Request
{
  std::string                         file; ///< of the scene, as it was given
  std::vector<std::string>            set;  ///< entries of the scene overridden on the command line
  std::optional<coupling::RunOptions> run;  ///< of a run
  coupling::GeometricStiffness        geometric = coupling::GeometricStiffness::included; ///< of its modes
};

/// The machine at the extreme of one signal.
struct PeakState
{
  std::string     signal, unit;
  double          value = 0., t = 0.; ///< in SI, [s]
  Eigen::VectorXd q;
  double          half_swing = 0.; ///< [s] half a period of the vibration it belongs to; 0: unknown
};

/// All that is written about one computation: plain values, gathered by whoever computed them.
struct Result
{
  std::string scene;       ///< name of the scene
  std::string description; ///< what the scene says about itself, may be empty
  std::string version;     ///< of the program
  std::string commit;      ///< that it was built from; empty: unknown
  std::string command;     ///< "run", "modes", "frf"
  std::string settings;    ///< how it was computed, plain text for the report, may be empty

  Request                                     requested;
  ModelFacts                                  model;
  std::vector<std::pair<std::string, double>> wall_s; ///< phase, seconds; in the order of the work
  std::optional<coupling::RunResult>          run;    ///< absent where only modes were computed
  std::vector<coupling::Mode>                 frame_modes;
  std::vector<coupling::Mode>                 coupled_modes;
  std::optional<coupling::EnergyShares>       energy_shares;    ///< of the coupled modes
  Eigen::VectorXd                             modes_at;         ///< q of the machine that they are linearised at
  std::optional<PeakState>                    peak;             ///< of a run: see main_peak()
  std::vector<coupling::Pole>                 poles;            ///< with drives and lags, at the speeds of the start
  std::optional<RunStory>                     story;            ///< of a run with events
  std::optional<StressResult>                 stress;           ///< of a run that was asked for it
  std::optional<PeriodicResult>               periodic;         ///< of `periodic`, the first solution as a run
  std::optional<SizeResult>                   size;             ///< of `size`, whose chosen model ran
  std::vector<std::string>                    coordinate_names; ///< of the machine, for mode shapes without a picture
  std::vector<std::string>                    bodies_from_cad;  ///< what was found of each, for people
  std::vector<std::string>                    warnings;         ///< beyond those of the run
  Answers                                     answers;          ///< of analyses, apps/analysis
  Scenery                                     scenery;
};

/// Findings of the result and of its run, each once, in this order; an early end of the run comes first.
std::vector<coupling::Finding> all_findings(const Result &result);
/// Their texts.
std::vector<std::string> all_warnings(const Result &result);

} // namespace gestell::apps
