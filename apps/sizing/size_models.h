#pragma once

#include "apps/output/values/size_result.h"
#include "apps/sizing/error_budget.h"
#include "apps/sizing/size_laws.h"

namespace gestell::apps
{

constexpr double coarsest_mesh = ratio_of_meshes * ratio_of_meshes; ///< of the scene's size: the search begins there

/// [byte] that the program has taken at most so far; 0: the system does not say.
double memory_taken();

/// A model of a scene: mesh, modes and integration.
struct SizePlace
{
  Cells  cells = Cells::given;
  double mesh  = 1.; ///< size of the cells, of that in the scene
  int    modes = -1; ///< below zero: not chosen
  double time  = 0.; ///< tolerance or step [s]

  bool operator==(const SizePlace &other) const
  {
    return cells == other.cells && mesh == other.mesh && modes == other.modes && time == other.time;
  }
};

/// A model whose errors are known.
struct SizedPlace
{
  SizePlace   place;
  JudgedModel model;
  MeshPoint   point;
  SizeRung    rung;              ///< with the largest error of an output, of what is allowed
  double      work      = 1.;    ///< to judge it, of the CPU time of the model
  bool        confirmed = false; ///< by a finer mesh
};

/// The models of a scene that a search goes over.
class SizeModels
{
public:
  /// @param tolerance  relative error that each output may have
  /// @throws std::invalid_argument if it is not between 1e-8 and 1
  SizeModels(const Scene &scene, const std::vector<OutputName> &outputs, double tolerance,
             const std::atomic<bool> *stop);

  /// The coarse one to begin with: cells of 9/4 of the scene's size, 8 modes, `exact` to 1e-3 or, where that does not
  /// treat the machine, eight of the scene's steps, or as many as it can be integrated with.
  /// @throws std::invalid_argument if the scene gives no step to vary
  SizePlace coarse();

  /// Whether those of the coarse one, once it is judged, do for a model.
  bool has_frames(const SizePlace &place) const
  {
    return judged_first_ && place.mesh == first_.mesh && place.modes < first_.modes && place.cells != Cells::swept;
  }
  /// On the cells of the coarse one fewer modes are taken from its frames.
  SizedPlace judge(const SizePlace &place, double most_cells = 0.);
  /// Takes the answer of the model with a frame of its own, which a frame of first modes gives but for rounding.
  void settle(SizedPlace &judged);
  /// Raises the error of the mesh to the difference from a model on another, where that is larger: elements of degree
  /// three on coarse cells do not see all.
  void         compare(SizedPlace &judged, const ModelAnswer &finer) const;
  ModelVariant variant_of(const SizePlace &place, double most_cells = 0.) const;
  SizeRung     rung_of(const SizePlace &place, const ModelAnswer &answer) const;
  /// Size against which errors of an output count.
  double scale_of(std::size_t output, const ModelAnswer &answer) const;
  /// That a frame can keep.
  int most_modes() const;
  /// By how much integrations of the search differ, and the power of the error in it.
  struct TimeLaw
  {
    double factor = 10., order = 1., finest = 0.;
  };
  TimeLaw time_law() const;
  bool    by_steps() const; ///< of one length
  /// Models about a chosen one, itself among them: up to one rung finer in each part, none coarser than the coarsest.
  std::vector<SizePlace> about(const SizePlace &chosen, const SizePlace &coarsest) const;

  ModelAnswers &answers() { return models_; }

private:
  bool   takes_exact(const SizePlace &place);
  void   take_shares(SizedPlace &judged) const;
  Shares shares_of(const BudgetEntry &entry, double allowed) const;

  const Scene                   &scene_;
  const std::vector<OutputName> &outputs_;
  const double                   tolerance_;
  const std::atomic<bool>       *stop_;
  ModelAnswers                   models_;
  bool                           by_exact_ = true, judged_first_ = false;
  SizePlace                      first_; ///< the coarse one
};

} // namespace gestell::apps
