#pragma once

#include "apps/peers/first_order_form.h"
#include "apps/peers/peer.h"

#include <functional>
#include <memory>

namespace gestell::peers
{

/// One step of a general-purpose library.
class Stepper
{
public:
  enum class Outcome
  {
    step,
    root, ///< the step ends where a monitored guard crossed zero; see root()
    failed
  };

  virtual ~Stepper() = default;

  virtual Outcome            step()                                    = 0;
  virtual double             time() const                              = 0;
  virtual const double      *state() const                             = 0; ///< y at time()
  virtual void               interpolate(double t, double *y)          = 0; ///< inside the last step
  virtual void               restart(double t, const double *y)        = 0; ///< forces change at t
  virtual void               watch(const std::vector<int> &directions) = 0; ///< +1 rising, -1 falling, for each guard
  virtual int                root()                                    = 0; ///< the guard that crossed zero
  virtual void               count(coupling::IntegrationWork &work)    = 0; ///< adds steps, rejected, newton
  virtual const std::string &failure() const                           = 0;
};

/// Data for the callbacks of a library: the system, and the guards if events are located.
struct Callbacks
{
  FirstOrderForm                                           &form;
  std::function<void(double t, const double *y, double *g)> guards;
};

std::unique_ptr<Stepper> make_cvode(Callbacks &callbacks, const PeerProblem &problem, const PeerOptions &options);
std::unique_ptr<Stepper> make_ida(Callbacks &callbacks, const PeerProblem &problem, const PeerOptions &options);
/// From the plugin with PETSc, which is loaded at the first call.
std::unique_ptr<Stepper> make_petsc(Callbacks &callbacks, const PeerProblem &problem, const PeerOptions &options);
std::unique_ptr<Stepper> make_explicit_rk(Callbacks &callbacks, const PeerProblem &problem, const PeerOptions &options);

} // namespace gestell::peers
