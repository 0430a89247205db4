// IDA as a Stepper.

#include "apps/peers/sundials.h"

#include <ida/ida.h>
#include <ida/ida_ls.h>
#include <sunmatrix/sunmatrix_dense.h>

namespace gestell::peers
{
namespace
{

int residual(double t, N_Vector y, N_Vector y_rate, N_Vector r, void *user)
{
  static_cast<Callbacks *>(user)->form.residual(t, values(y), values(y_rate), values(r));
  return 0;
}

int set_up_condensed(double t, double c_j, N_Vector y, N_Vector, N_Vector, SUNMatrix, void *user, N_Vector, N_Vector,
                     N_Vector)
{
  FirstOrderForm &form = static_cast<Callbacks *>(user)->form;
  form.linearise(t, values(y));
  return form.factorise(1. / c_j) ? 0 : 1;
}

int jacobian(double t, double c_j, N_Vector y, N_Vector, N_Vector, SUNMatrix J, void *user, N_Vector, N_Vector,
             N_Vector)
{
  FirstOrderForm &form = static_cast<Callbacks *>(user)->form;
  form.linearise(t, values(y));
  return form.residual_jacobian(1. / c_j, Eigen::Map<Eigen::MatrixXd>(SM_DATA_D(J), form.size(), form.size())) ? 0 : -1;
}

int guards(double t, N_Vector y, N_Vector, double *g, void *user)
{
  static_cast<Callbacks *>(user)->guards(t, values(y), g);
  return 0;
}

constexpr SundialsCalls calls = {IDAGetDky, IDAGetRootInfo, IDASetRootDirection, IDASetNoInactiveRootWarn};

class Ida : public SundialsStepper
{
public:
  Ida(Callbacks &callbacks, const PeerProblem &problem, const PeerOptions &options)
      : SundialsStepper(calls, callbacks, problem, options, true), callbacks_(callbacks), y_rate_(parts_.vector()),
        dense_(options.solver == PeerSolver::dense)
  {
    memory_ = IDACreate(parts_.context);
#if SUNDIALS_VERSION_MAJOR < 7 // later ones have messages of the context
    IDASetErrHandlerFn(memory_, keep_message, &parts_.failure);
#endif
    callbacks_.form.rate(t_, values(parts_.y), values(y_rate_));
    expect(IDAInit(memory_, residual, problem.t, parts_.y, y_rate_), "IDAInit");
    IDASetUserData(memory_, &callbacks);
    IDASetMaxOrd(memory_, options.order);
    IDASetMaxNumSteps(memory_, -1);
    expect(IDASVtolerances(memory_, options.tolerance, parts_.weights), "IDASVtolerances");
    expect(IDASetLinearSolver(memory_, parts_.solver, parts_.matrix), "IDASetLinearSolver");
    expect(IDASetJacFn(memory_, dense_ ? jacobian : set_up_condensed), "IDASetJacFn");
  }
  ~Ida() override { IDAFree(&memory_); }

  Outcome step() override
  {
    const int code = IDASolve(memory_, end_, &t_, parts_.y, y_rate_, IDA_ONE_STEP);
    return code < 0 ? Outcome::failed : code == IDA_ROOT_RETURN ? Outcome::root : Outcome::step;
  }

private:
  void begin_again() override
  {
    callbacks_.form.rate(t_, values(parts_.y), values(y_rate_));
    expect(IDAReInit(memory_, t_, parts_.y, y_rate_), "IDAReInit");
  }
  int                       watch_guards(int n) override { return IDARootInit(memory_, n, n > 0 ? guards : nullptr); }
  coupling::IntegrationWork work_since_begin() const override
  {
    long steps = 0, rejected = 0, failed = 0, newton = 0, set_ups = 0;
    IDAGetNumSteps(memory_, &steps);
    IDAGetNumErrTestFails(memory_, &rejected);
    IDAGetNumNonlinSolvConvFails(memory_, &failed);
    IDAGetNumNonlinSolvIters(memory_, &newton);
    IDAGetNumLinSolvSetups(memory_, &set_ups);
    return {steps, rejected + failed, newton, dense_ ? set_ups : 0, dense_ ? newton : 0};
  }

  Callbacks &callbacks_;
  N_Vector   y_rate_;
  bool       dense_;
};

} // namespace

std::unique_ptr<Stepper> make_ida(Callbacks &callbacks, const PeerProblem &problem, const PeerOptions &options)
{
  return std::make_unique<Ida>(callbacks, problem, options);
}

} // namespace gestell::peers
