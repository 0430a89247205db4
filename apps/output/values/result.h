#pragma once

#include "apps/output/values/answer.h"
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

/// Size and accuracy of the model.  Counts below zero and nan mean: does not apply.
struct ModelFacts
{
  int dofs       = -1; ///< DOFs of the integrated model
  int interface  = -1; ///< interface DOFs q1 of the frame, which remain physical
  int modes      = -1; ///< number of retained internal modes of the frame
  int nonlinear  = -1; ///< number of measures of the nonlinear elements, which is the size of a Newton step
  int frame_dofs = -1; ///< DOFs of the unreduced frame
  int superposed = -1; ///< DOFs of frame and mechanism that are replaced by modes
  int cells      = -1; ///< finite elements

  double frame_mass      = std::numeric_limits<double>::quiet_NaN(); ///< [kg]
  double frequency_error = std::numeric_limits<double>::quiet_NaN(); ///< largest estimate of the reduction, relative
  double static_residual = std::numeric_limits<double>::quiet_NaN(); ///< see coupling::ReducedFrame
  double frequency_limit =
      std::numeric_limits<double>::quiet_NaN(); ///< [Hz] upper limit of validity of a reduced frame

  fem::FrameFacts frame;            ///< of a frame with finite elements
  int             free_motions = 0; ///< number of rigid-body modes of the frame
  std::string     damping;          ///< of the frame, for people
  std::string
      mesh; ///< what is unknown about the frame's mesh error, for people; else a statement or a warning gives the error
  std::vector<std::string> statements; ///< checks of the frame that passed
};

/// What the user requested.
struct Request
{
  std::string                         file; ///< the scene file, as given
  std::vector<std::string>            set;  ///< scene keys overridden on the command line
  std::optional<coupling::RunOptions> run;  ///< of a run
  coupling::GeometricStiffness        geometric = coupling::GeometricStiffness::included; ///< of its modes
};

/// State of the machine at the extreme of one signal.
struct PeakState
{
  std::string     signal, unit;
  double          value = 0., t = 0.; ///< in SI, [s]
  Eigen::VectorXd q;
  double          half_swing = 0.; ///< [s] half a period of the vibration that the extreme is part of; 0: unknown
};

/// All data that are written about one computation: plain values, collected by the command that computed them.
struct Result
{
  std::string scene;       ///< name of the scene
  std::string description; ///< from the scene, may be empty
  std::string version;     ///< of the program
  std::string commit;      ///< that the program was built from; empty: unknown
  std::string command;     ///< "run", "modes", "frf"
  std::string settings;    ///< method and options, plain text for the report, may be empty

  Request                                     requested;
  ModelFacts                                  model;
  std::vector<std::pair<std::string, double>> wall_s; ///< phase, seconds; in the order of execution
  std::optional<coupling::RunResult>          run;    ///< absent if only modes were computed
  std::vector<coupling::Mode>                 frame_modes;
  std::vector<coupling::Mode>                 coupled_modes;
  std::optional<coupling::EnergyShares>       energy_shares;    ///< of the coupled modes
  Eigen::VectorXd                             modes_at;         ///< configuration q of the coupled modes
  std::optional<PeakState>                    peak;             ///< of a run: see main_peak()
  std::vector<coupling::Pole>                 poles;            ///< including drives and lags, at the initial speeds
  std::optional<RunStory>                     story;            ///< of a run with events
  std::optional<StressResult>                 stress;           ///< of a run with requested stresses
  std::optional<SizeResult>                   size;             ///< of `size`; `run` is that of the chosen model
  std::vector<std::string>                    coordinate_names; ///< of the machine, for mode shapes without a picture
  std::vector<std::string>                    bodies_from_cad;  ///< what was determined for each, for people
  std::vector<std::string>                    warnings;         ///< in addition to those of the run
  Answers                                     answers;          ///< of analyses, apps/analysis
  Scenery                                     scenery;
};

/// Findings of the result and of its run, each once, in this order; an early end of the run comes first.
std::vector<coupling::Finding> all_findings(const Result &result);
/// Their texts.
std::vector<std::string> all_warnings(const Result &result);

} // namespace gestell::apps
