// CVODE as a Stepper.

#include "apps/peers/sundials.h"

#include <cvode/cvode.h>
#include <cvode/cvode_ls.h>
#include <sunmatrix/sunmatrix_dense.h>

namespace gestell::peers
{
namespace
{

/// The tangent costs next to nothing, so that it is renewed whenever CVODE sets up its linear system.
int set_up_condensed(double t, N_Vector y, N_Vector, SUNMatrix, sunbooleantype, sunbooleantype *current, double gamma,
                     void *user, N_Vector, N_Vector, N_Vector)
{
  FirstOrderForm &form = static_cast<Callbacks *>(user)->form;
  form.linearise(t, values(y));
  *current = SUNTRUE;
  return form.factorise(gamma) ? 0 : 1;
}

int jacobian(double t, N_Vector y, N_Vector, SUNMatrix J, void *user, N_Vector, N_Vector, N_Vector)
{
  FirstOrderForm &form = static_cast<Callbacks *>(user)->form;
  form.linearise(t, values(y));
  form.rate_jacobian(Eigen::Map<Eigen::MatrixXd>(SM_DATA_D(J), form.size(), form.size()));
  return 0;
}

constexpr SundialsCalls calls = {CVodeGetDky, CVodeGetRootInfo, CVodeSetRootDirection, CVodeSetNoInactiveRootWarn};

class Cvode : public SundialsStepper
{
public:
  Cvode(Callbacks &callbacks, const PeerProblem &problem, const PeerOptions &options)
      : SundialsStepper(calls, callbacks, problem, options, true), dense_(options.solver == PeerSolver::dense)
  {
    const bool adams = options.kind == PeerKind::cvode_adams;
    memory_          = CVodeCreate(adams ? CV_ADAMS : CV_BDF, parts_.context);
#if SUNDIALS_VERSION_MAJOR < 7 // later ones have messages of the context
    CVodeSetErrHandlerFn(memory_, keep_message, &parts_.failure);
#endif
    expect(CVodeInit(memory_, state_rate, problem.t, parts_.y), "CVodeInit");
    CVodeSetUserData(memory_, &callbacks);
    CVodeSetMaxOrd(memory_, options.order);
    CVodeSetMaxNumSteps(memory_, -1);
    CVodeSetMaxHnilWarns(memory_, -1);
    expect(CVodeSVtolerances(memory_, options.tolerance, parts_.weights), "CVodeSVtolerances");
    expect(CVodeSetLinearSolver(memory_, parts_.solver, parts_.matrix), "CVodeSetLinearSolver");
    if (dense_)
      expect(CVodeSetJacFn(memory_, jacobian), "CVodeSetJacFn");
    else
      expect(CVodeSetLinSysFn(memory_, set_up_condensed), "CVodeSetLinSysFn");
  }
  ~Cvode() override { CVodeFree(&memory_); }

  Outcome step() override
  {
    const int code = CVode(memory_, end_, parts_.y, &t_, CV_ONE_STEP);
    return code < 0 ? Outcome::failed : code == CV_ROOT_RETURN ? Outcome::root : Outcome::step;
  }

private:
  void begin_again() override { expect(CVodeReInit(memory_, t_, parts_.y), "CVodeReInit"); }
  int  watch_guards(int n) override { return CVodeRootInit(memory_, n, n > 0 ? guard_values : nullptr); }
  coupling::IntegrationWork work_since_begin() const override
  {
    long steps = 0, rejected = 0, failed = 0, newton = 0, set_ups = 0;
    CVodeGetNumSteps(memory_, &steps);
    CVodeGetNumErrTestFails(memory_, &rejected);
    CVodeGetNumNonlinSolvConvFails(memory_, &failed);
    CVodeGetNumNonlinSolvIters(memory_, &newton);
    CVodeGetNumLinSolvSetups(memory_, &set_ups);
    return {steps, rejected + failed, newton, dense_ ? set_ups : 0, dense_ ? newton : 0};
  }

  bool dense_;
};

} // namespace

std::unique_ptr<Stepper> make_cvode(Callbacks &callbacks, const PeerProblem &problem, const PeerOptions &options)
{
  return std::make_unique<Cvode>(callbacks, problem, options);
}

} // namespace gestell::peers
