// IDA behind Stepper.

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

class Ida : public Stepper
{
public:
  Ida(Callbacks &callbacks, const PeerProblem &problem, const PeerOptions &options)
      : callbacks_(callbacks), parts_(callbacks, problem, options, true), y_rate_(parts_.vector()),
        output_(parts_.vector()), t_(problem.t), end_(problem.samples.back()),
        dense_(options.solver == PeerSolver::dense)
  {
    memory_ = IDACreate(parts_.context);
    IDASetErrHandlerFn(memory_, keep_message, &parts_.failure);
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
  double        time() const override { return t_; }
  const double *state() const override { return values(parts_.y); }
  void          interpolate(double t, double *y) override
  {
    IDAGetDky(memory_, t, 0, output_);
    std::copy(values(output_), values(output_) + N_VGetLength(output_), y);
  }
  void restart(double t, const double *y) override
  {
    count(past_);
    t_ = t;
    std::copy(y, y + N_VGetLength(parts_.y), values(parts_.y));
    callbacks_.form.rate(t, y, values(y_rate_));
    expect(IDAReInit(memory_, t, parts_.y, y_rate_), "IDAReInit");
  }
  void watch(const std::vector<int> &directions) override
  {
    found_.assign(directions.size(), 0);
    expect(IDARootInit(memory_, 0, nullptr), "IDARootInit");
    expect(IDARootInit(memory_, int(directions.size()), guards), "IDARootInit");
    std::vector<int> copy = directions;
    if (!copy.empty())
      expect(IDASetRootDirection(memory_, copy.data()), "IDASetRootDirection");
    IDASetNoInactiveRootWarn(memory_);
  }
  int root() override
  {
    IDAGetRootInfo(memory_, found_.data());
    for (std::size_t i = 0; i < found_.size(); ++i)
      if (found_[i] != 0)
        return int(i);
    return 0;
  }
  void count(coupling::IntegrationWork &work) override
  {
    long steps = 0, rejected = 0, failed = 0, newton = 0, set_ups = 0;
    IDAGetNumSteps(memory_, &steps);
    IDAGetNumErrTestFails(memory_, &rejected);
    IDAGetNumNonlinSolvConvFails(memory_, &failed);
    IDAGetNumNonlinSolvIters(memory_, &newton);
    IDAGetNumLinSolvSetups(memory_, &set_ups);
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
  Callbacks                &callbacks_;
  SundialsParts             parts_;
  N_Vector                  y_rate_, output_;
  void                     *memory_ = nullptr;
  double                    t_, end_;
  bool                      dense_;
  std::vector<int>          found_;
  coupling::IntegrationWork past_; ///< before the last restart, as IDA begins to count anew
};

} // namespace

std::unique_ptr<Stepper> make_ida(Callbacks &callbacks, const PeerProblem &problem, const PeerOptions &options)
{
  return std::make_unique<Ida>(callbacks, problem, options);
}

} // namespace gestell::peers
