#pragma once

#include "apps/output/values/size_result.h"
#include "apps/sizing/error_budget.h"
#include "apps/sizing/size_laws.h"

#include <deque>

namespace gestell::apps
{

constexpr double coarsest_mesh = ratio_of_meshes * ratio_of_meshes; ///< of the scene's size: start of the search

/// Peak memory [byte] of the program; 0: the system does not report it.
double memory_taken();

/// A model of a scene: mesh, modes and integration.
struct SizePlace
{
  Cells  cells = Cells::given;
  double mesh  = 1.; ///< size of the elements, relative to that in the scene
  int    modes = -1; ///< below zero: no choice
  double time  = 0.; ///< tolerance or step [s]

  bool operator==(const SizePlace &other) const
  {
    return cells == other.cells && mesh == other.mesh && modes == other.modes && time == other.time;
  }
};

/// A model with known errors.
struct SizedPlace
{
  SizePlace   place;
  JudgedModel model;
  MeshPoint   point;
  SizeRung    rung;              ///< with the largest error of an output relative to the allowed error
  double      work      = 1.;    ///< CPU time of the error estimate, in CPU times of the model
  bool        confirmed = false; ///< by a finer mesh
};

/// The models of a scene for the search.
class SizeModels
{
public:
  /// @param tolerance  allowed relative error of each output
  /// @throws std::invalid_argument if it is not between 1e-8 and 1
  SizeModels(const Scene &scene, const std::vector<OutputName> &outputs, double tolerance,
             const std::atomic<bool> *stop);

  /// The coarse model at the start: elements of 9/4 of the scene's size, 8 modes, `exact` to 1e-3.  If `exact` cannot
  /// treat the machine: eight of the scene's steps, or the largest multiple with which it can be integrated.
  /// Elements of 3/2 of the size, or of the size itself, if the frame of larger ones cannot be made.
  /// @throws std::invalid_argument if the scene gives no step to vary; FrameFailure if no frame can be made
  SizePlace coarse();
  /// Models that failed, each with the reason.
  const std::vector<std::string> &skipped() const { return skipped_; }
  /// Adds one.  @return whether the search may go on with other cells: no frame was made, of one of few models
  bool skip(const SizePlace &place, const std::exception &failure);

  /// Whether the frames of the coarse model, once computed, can be used for this model.
  bool has_frames(const SizePlace &place) const
  {
    return judged_first_ && place.mesh == first_.mesh && place.modes < first_.modes && place.cells != Cells::swept;
  }
  /// Estimates the errors of a model.  On the mesh of the coarse model with fewer modes its frames are truncated.
  SizedPlace judge(const SizePlace &place, double most_cells = 0.);
  /// Replaces the answer by that of the model with its own frame; a truncated frame differs from it only by rounding.
  void settle(SizedPlace &judged);
  /// Raises the mesh error to the difference from a model on another mesh, if that is larger: elements of degree three
  /// on coarse meshes do not reveal all errors.
  void         compare(SizedPlace &judged, const ModelAnswer &finer) const;
  ModelVariant variant_of(const SizePlace &place, double most_cells = 0.) const;
  SizeRung     rung_of(const SizePlace &place, const ModelAnswer &answer) const;
  /// Size of an output for relative errors.
  double scale_of(std::size_t output, const ModelAnswer &answer) const;
  /// Largest number of modes for the frame.
  int most_modes() const;
  /// Ratio of successive settings of the integration, and the exponent of the error in it.
  struct TimeLaw
  {
    double factor = 10., order = 1., finest = 0.;
  };
  TimeLaw time_law() const;
  bool    by_steps() const; ///< with a constant step
  /// Models around a chosen one, including itself: up to one level finer in each part, none coarser than `coarsest`.
  std::vector<SizePlace> about(const SizePlace &chosen, const SizePlace &coarsest) const;

  ModelAnswers &answers() { return models_; }

private:
  SizePlace coarse_on(SizePlace place);
  bool      takes_exact(const SizePlace &place);
  void      take_shares(SizedPlace &judged) const;
  Shares    shares_of(const BudgetEntry &entry, double allowed) const;

  const Scene                   &scene_;
  const std::vector<OutputName> &outputs_;
  const double                   tolerance_;
  const std::atomic<bool>       *stop_;
  ModelAnswers                   models_;
  bool                           by_exact_ = true, judged_first_ = false;
  SizePlace                      first_; ///< the coarse model
  std::vector<std::string>       skipped_;
};

/// The smallest model that keeps the tolerance; null: none.
SizedPlace *best_of(std::deque<SizedPlace> &judged);

} // namespace gestell::apps
