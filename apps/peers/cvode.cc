// CVODE behind Stepper.

#include "apps/peers/sundials.h"

#include <cvode/cvode.h>
#include <cvode/cvode_ls.h>
#include <sunmatrix/sunmatrix_dense.h>

namespace gestell::peers
{
namespace
{

int rate(double t, N_Vector y, N_Vector y_rate, void *user)
{
  static_cast<Callbacks *>(user)->form.rate(t, values(y), values(y_rate));
  return 0;
}

/// The tangent costs next to nothing, so that it is renewed whenever CVODE sets up its linear system.
int set_up_condensed(double t, N_Vector y, N_Vector, SUNMatrix, booleantype, booleantype *current, double gamma,
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

int guards(double t, N_Vector y, double *g, void *user)
{
  static_cast<Callbacks *>(user)->guards(t, values(y), g);
  return 0;
}

class Cvode : public Stepper
{
public:
  Cvode(Callbacks &callbacks, const PeerProblem &problem, const PeerOptions &options)
      : parts_(callbacks, problem, options, true), output_(parts_.vector()), t_(problem.t),
        end_(problem.samples.back()), dense_(options.solver == PeerSolver::dense)
  {
    const bool adams = options.kind == PeerKind::cvode_adams;
    memory_          = CVodeCreate(adams ? CV_ADAMS : CV_BDF, parts_.context);
    CVodeSetErrHandlerFn(memory_, keep_message, &parts_.failure);
    expect(CVodeInit(memory_, rate, problem.t, parts_.y), "CVodeInit");
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
  double        time() const override { return t_; }
  const double *state() const override { return values(parts_.y); }
  void          interpolate(double t, double *y) override
  {
    CVodeGetDky(memory_, t, 0, output_);
    std::copy(values(output_), values(output_) + N_VGetLength(output_), y);
  }
  void restart(double t, const double *y) override
  {
    count(past_);
    t_ = t;
    std::copy(y, y + N_VGetLength(parts_.y), values(parts_.y));
    expect(CVodeReInit(memory_, t, parts_.y), "CVodeReInit");
  }
  void watch(const std::vector<int> &directions) override
  {
    found_.assign(directions.size(), 0);
    expect(CVodeRootInit(memory_, 0, nullptr), "CVodeRootInit");
    expect(CVodeRootInit(memory_, int(directions.size()), guards), "CVodeRootInit");
    std::vector<int> copy = directions;
    if (!copy.empty())
      expect(CVodeSetRootDirection(memory_, copy.data()), "CVodeSetRootDirection");
    CVodeSetNoInactiveRootWarn(memory_);
  }
  int root() override
  {
    CVodeGetRootInfo(memory_, found_.data());
    for (std::size_t i = 0; i < found_.size(); ++i)
      if (found_[i] != 0)
        return int(i);
    return 0;
  }
  void count(coupling::IntegrationWork &work) override
  {
    long steps = 0, rejected = 0, failed = 0, newton = 0, set_ups = 0;
    CVodeGetNumSteps(memory_, &steps);
    CVodeGetNumErrTestFails(memory_, &rejected);
    CVodeGetNumNonlinSolvConvFails(memory_, &failed);
    CVodeGetNumNonlinSolvIters(memory_, &newton);
    CVodeGetNumLinSolvSetups(memory_, &set_ups);
    if (dense_)
      work.factorisations += set_ups, work.solves += newton;
    work.steps += steps;
    work.rejected += rejected + failed;
    work.newton += newton;
    if (&work == &past_)
      return;
    work.steps += past_.steps, work.rejected += past_.rejected, work.newton += past_.newton;
    work.factorisations += past_.factorisations, work.solves += past_.solves;
  }
  const std::string &failure() const override { return parts_.failure; }

private:
  SundialsParts             parts_;
  N_Vector                  output_;
  void                     *memory_ = nullptr;
  double                    t_, end_;
  bool                      dense_;
  std::vector<int>          found_;
  coupling::IntegrationWork past_; ///< before the last restart, as CVODE begins to count anew
};

} // namespace

std::unique_ptr<Stepper> make_cvode(Callbacks &callbacks, const PeerProblem &problem, const PeerOptions &options)
{
  return std::make_unique<Cvode>(callbacks, problem, options);
}

} // namespace gestell::peers
