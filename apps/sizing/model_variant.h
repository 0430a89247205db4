#pragma once

#include "apps/output/values/result.h"
#include "apps/scene/scene.h"
#include "apps/sizing/model_choices.h"
#include "apps/sizing/output_name.h"

#include <Eigen/Core>

#include <atomic>
#include <exception>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace gestell::apps
{

/// How the geometry of a frame is meshed.
enum class Cells
{
  given,    ///< as the scene says
  straight, ///< tetrahedra
  curved,   ///< tetrahedra whose sides follow the geometry
  swept     ///< plates in hexahedra
};

/// How a model differs from that of the scene.
struct ModelVariant
{
  double                                 mesh  = 1.;  ///< size of the cells, of that in the scene
  int                                    modes = -1;  ///< that the frame keeps; below zero: as the scene says
  std::optional<coupling::MethodOptions> method;      ///< of integration; none: that of the scene
  std::string                            reduction{}; ///< a name of coupling::Reductions; empty: that of the scene
  Cells                                  cells  = Cells::given;
  bool                                   raised = false; ///< the elements of its mesh have degree three
  /// Modes of the frame that is made, of which the first `modes` are kept (with_first_modes()); fewer, or where the
  /// reduction is not nested: those kept.
  int    made       = -1;
  double most_cells = 0.; ///< that its mesh may have; 0: as the scene says
};

/// What a model answers, and what it costs.
struct ModelAnswer
{
  explicit ModelAnswer(std::size_t n_outputs = 0, double begin = 0.);

  std::vector<double>          values; ///< of the outputs asked for
  std::vector<double>          sizes;  ///< largest of the signal without its sign, of a mode its frequency
  std::vector<std::string>     units;
  std::vector<double>          decided_s; ///< time until which each is decided; for a mode the start of the run
  std::vector<coupling::Event> events;
  std::string                  method;             ///< of integration, for people
  int                          n_frame    = 0;     ///< coordinates of the unreduced frame; 0: none
  int                          interface  = 0;     ///< coordinates that stay physical
  int                          modes      = -1;    ///< that the frame keeps, or that the machine is superposed of
  int                          most_modes = 0;     ///< that it could keep
  Eigen::VectorXd              omega;              ///< [modes] theirs [rad/s], ascending; empty: not known
  bool                         whole      = false; ///< the frame is not reduced
  bool                         superposed = false; ///< the modes are those of the machine
  std::vector<char>            recovered;          ///< [outputs] an internal force or a stress of the frame
  std::vector<Eigen::VectorXd> histories;          ///< [outputs] of the signal, in equal intervals; empty: not of one
  double                       prepare_cpu = 0., run_cpu = 0.; ///< [s]

  double cpu() const { return prepare_cpu + run_cpu; }
};

/// As reduction.modes has it: of a frame of parts each part's, below zero where they are chosen by themselves.
int modes_asked(const Scene &scene, const ModelAnswer &answer);
/// Of a model to compare with: twice the modes, eight more at least; of none, below zero, none.
int more_than(int modes);
/// The same, as many as there are.
int more_modes(const Scene &scene, const ModelAnswer &answer);

/// The answer that a run of the scene has given.
ModelAnswer answer_of(const Result &result, const std::vector<OutputName> &outputs);

/// A scene with the variant's mesh, number of modes and method.
Scene varied(const Scene &scene, const ModelVariant &variant);

/// The frame of a model cannot be made: its mesh, its memory, its reduction.
class FrameFailure : public std::invalid_argument
{
public:
  using std::invalid_argument::invalid_argument;
};

/// Runs it.
/// @throws FrameFailure; std::invalid_argument if the method cannot treat it; coupling::ConvergenceFailure if the run
/// fails or is
///         interrupted
ModelAnswer answer_of(const Scene &scene, const ModelVariant &variant, const std::vector<OutputName> &outputs,
                      const std::atomic<bool> *stop = nullptr);

/// The answers of models of one scene, each computed once.
class ModelAnswers
{
public:
  ModelAnswers(const Scene &scene, const std::vector<OutputName> &outputs, const std::atomic<bool> *stop)
      : scene_(scene), outputs_(outputs), stop_(stop)
  {
  }

  /// @throws as answer_of(), again for a model that failed before; coupling::ConvergenceFailure if it is interrupted
  const ModelAnswer &of(const ModelVariant &model);
  /// One that is known already.
  void know(const ModelVariant &model, const ModelAnswer &answer);

  const Scene                   &scene() const { return scene_; }
  const std::vector<OutputName> &outputs() const { return outputs_; }
  const std::atomic<bool>       *stop() const { return stop_; }
  KnownPlanes                   &planes() { return planes_; }

private:
  const Scene                              &scene_;
  const std::vector<OutputName>            &outputs_;
  const std::atomic<bool>                  *stop_;
  std::map<std::string, ModelAnswer>        known_;
  std::map<std::string, std::exception_ptr> failed_;
  KnownPlanes                               planes_;
};

/// Integrates as exactly as the program can where `exact` treats the machine: order 8, tolerance 1e-10.
coupling::MethodOptions finest_method(const Scene &scene);
/// A finer one of the same kind: half the step, a sixteenth of the tolerance.
coupling::MethodOptions finer_method(const coupling::MethodOptions &given);

/// Names of the scene's signals.
std::vector<std::string> signal_names(const Scene &scene);

} // namespace gestell::apps
