// PETSc TS as a Stepper; a plugin, see petsc_loader.cc.

#include "apps/peers/stepper.h"
#include "coupling/integration/system/hermite.h"

#include <petscts.h>

#include <stdexcept>

namespace gestell::peers
{
namespace
{

void expect(PetscErrorCode code, const char *call)
{
  if (code != 0)
    throw std::invalid_argument(std::string("peers: ") + call + " returned " + std::to_string(int(code)));
}

/// The numbers of a vector, for reading or writing.
class Values
{
public:
  explicit Values(Vec x) : x_(x) { VecGetArray(x, &values_); }
  ~Values() { VecRestoreArray(x_, &values_); }
  Values(const Values &)            = delete;
  Values &operator=(const Values &) = delete;

  operator double *() const { return values_; }

private:
  Vec     x_;
  double *values_ = nullptr;
};

/// Read access to a vector that PETSc may have locked.
class ConstValues
{
public:
  explicit ConstValues(Vec x) : x_(x) { VecGetArrayRead(x, &values_); }
  ~ConstValues() { VecRestoreArrayRead(x_, &values_); }
  ConstValues(const ConstValues &)            = delete;
  ConstValues &operator=(const ConstValues &) = delete;

  operator const double *() const { return values_; }

private:
  Vec           x_;
  const double *values_ = nullptr;
};

class PetscTs : public Stepper
{
public:
  PetscTs(Callbacks &callbacks, const PeerProblem &problem, const PeerOptions &options)
      : form_(callbacks.form), second_order_(options.kind == PeerKind::petsc_alpha), n_(problem.q.size()),
        t_(problem.t), t_before_(problem.t), y_(2 * n_), before_(2 * n_), work_y_(2 * n_)
  {
    initialise();
    y_ << problem.q, problem.v;
    const Eigen::Index size = second_order_ ? n_ : 2 * n_;
    expect(VecCreateSeq(PETSC_COMM_SELF, size, &u_), "VecCreateSeq");
    for (Vec *x : {&v_, &output_, &weights_})
      VecDuplicate(u_, x);
    {
      Values u(u_), v(v_), weights(weights_);
      std::copy(y_.data(), y_.data() + size, static_cast<double *>(u));
      std::copy(problem.v.data(), problem.v.data() + n_, static_cast<double *>(v));
      for (Eigen::Index i = 0; i < size; ++i)
        weights[i] = options.tolerance * (i < n_ ? problem.q_scale[i] : problem.v_scale[i - n_]);
    }
    expect(TSCreate(PETSC_COMM_SELF, &ts_), "TSCreate");
    MatCreateShell(PETSC_COMM_SELF, size, size, size, size, this, &matrix_);
    if (second_order_)
    {
      TSSetType(ts_, TSALPHA2);
      TSAlpha2SetRadius(ts_, 0.8);
      TSSetI2Function(ts_, nullptr, second_order_residual, this);
      TSSetI2Jacobian(ts_, matrix_, matrix_, second_order_matrix, this);
      TS2SetSolution(ts_, u_, v_);
    }
    else
    {
      TSSetType(ts_, TSBDF);
      TSBDFSetOrder(ts_, options.order);
      TSSetIFunction(ts_, nullptr, residual, this);
      TSSetIJacobian(ts_, matrix_, matrix_, matrix, this);
      TSSetSolution(ts_, u_);
    }
    set_up_newton();
    TSSetTime(ts_, problem.t);
    TSSetTimeStep(ts_, second_order_ ? options.step : 1e-7 * (problem.samples.back() - problem.t));
    TSSetMaxTime(ts_, 1e300);
    TSSetMaxSteps(ts_, PETSC_MAX_INT);
    TSSetMaxStepRejections(ts_, -1);
    TSSetMaxSNESFailures(ts_, -1);
    TSSetExactFinalTime(ts_, TS_EXACTFINALTIME_STEPOVER);
    TSSetErrorIfStepFails(ts_, PETSC_FALSE);
    TSSetTolerances(ts_, 0., weights_, options.tolerance, nullptr);
    TSAdapt adapt;
    TSGetAdapt(ts_, &adapt);
    TSAdaptSetType(adapt, second_order_ ? TSADAPTNONE : TSADAPTBASIC);
    expect(TSSetUp(ts_), "TSSetUp");
  }

  ~PetscTs() override
  {
    TSDestroy(&ts_);
    MatDestroy(&matrix_);
    for (Vec *x : {&u_, &v_, &output_, &weights_})
      VecDestroy(x);
  }

  Outcome step() override
  {
    before_                   = y_;
    t_before_                 = t_;
    const PetscErrorCode code = TSStep(ts_);
    TSConvergedReason    reason;
    TSGetConvergedReason(ts_, &reason);
    if (code != 0 || reason < 0)
    {
      failure_ = "PETSc: TSStep at t = " + std::to_string(t_) +
                 " s: " + (code != 0 ? "error " + std::to_string(int(code)) : std::string(TSConvergedReasons[reason]));
      return Outcome::failed;
    }
    TSGetTime(ts_, &t_);
    if (second_order_)
    {
      Vec u, v;
      TS2GetSolution(ts_, &u, &v);
      const ConstValues q(u), rate(v);
      std::copy(q + 0, q + n_, y_.data());
      std::copy(rate + 0, rate + n_, y_.data() + n_);
    }
    else
    {
      Vec u;
      TSGetSolution(ts_, &u);
      const ConstValues y(u);
      std::copy(y + 0, y + 2 * n_, y_.data());
    }
    return Outcome::step;
  }

  double        time() const override { return t_; }
  const double *state() const override { return y_.data(); }

  /// By TSInterpolate, or for alpha2, which has none, by Hermite's cubic.
  void interpolate(double t, double *y) override
  {
    if (!second_order_)
    {
      TSInterpolate(ts_, t, output_);
      const ConstValues values(output_);
      std::copy(values + 0, values + 2 * n_, y);
      return;
    }
    const double ends[]  = {t_before_, t_};
    const auto   weights = coupling::hermite_weights(ends, 2, t);
    for (Eigen::Index i = 0; i < n_; ++i)
    {
      const double q0 = before_[i], q1 = y_[i], v0 = before_[n_ + i], v1 = y_[n_ + i];
      y[i]      = weights.value[0] * q0 + weights.value[1] * q1 + weights.slope[0] * v0 + weights.slope[1] * v1;
      y[n_ + i] = weights.rate_value[0] * q0 + weights.rate_value[1] * q1 + weights.rate_slope[0] * v0 +
                  weights.rate_slope[1] * v1;
    }
  }

  void restart(double, const double *) override {} // only after events,
  void watch(const std::vector<int> &) override {} // which it ignores
  int  root() override { return 0; }
  void count(coupling::IntegrationWork &work) override
  {
    PetscInt steps = 0, rejected = 0, newton = 0;
    TSGetStepNumber(ts_, &steps);
    TSGetStepRejections(ts_, &rejected);
    TSGetSNESIterations(ts_, &newton);
    work.steps += steps;
    work.rejected += rejected;
    work.newton += newton;
  }
  const std::string &failure() const override { return failure_; }

private:
  static void initialise()
  {
    PetscBool done = PETSC_FALSE;
    PetscInitialized(&done);
    if (done)
      return;
    int begun = 0;
    MPI_Initialized(&begun);
    if (begun)
      PETSC_COMM_WORLD = MPI_COMM_SELF; // the other ranks of mpirun take no part
    expect(PetscInitializeNoArguments(), "PetscInitialize");
    PetscPushErrorHandler(PetscReturnErrorHandler, nullptr);
    PetscPopSignalHandler();
  }

  /// Newton with full steps; the condensed solver replaces both Krylov method and preconditioner.
  void set_up_newton()
  {
    SNES           newton;
    KSP            krylov;
    PC             solver;
    SNESLineSearch line_search;
    TSGetSNES(ts_, &newton);
    SNESGetLineSearch(newton, &line_search);
    SNESLineSearchSetType(line_search, SNESLINESEARCHBASIC);
    SNESSetTolerances(newton, 1e-50, 1e-5, 1e-8, 20, -1);
    SNESGetKSP(newton, &krylov);
    KSPSetType(krylov, KSPPREONLY);
    KSPGetPC(krylov, &solver);
    PCSetType(solver, PCSHELL);
    PCShellSetContext(solver, this);
    PCShellSetApply(solver, solve);
  }

  static PetscErrorCode residual(TS, PetscReal t, Vec y, Vec y_rate, Vec r, void *self)
  {
    const ConstValues state(y), rate(y_rate);
    static_cast<PetscTs *>(self)->form_.residual(t, state, rate, Values(r));
    return 0;
  }
  static PetscErrorCode matrix(TS, PetscReal t, Vec y, Vec, PetscReal shift, Mat, Mat, void *self)
  {
    FirstOrderForm &form = static_cast<PetscTs *>(self)->form_;
    form.linearise(t, ConstValues(y));
    return form.factorise(1. / shift) ? 0 : PETSC_ERR_CONV_FAILED;
  }

  const double *joined(Vec u, Vec v)
  {
    const ConstValues q(u), rate(v);
    std::copy(q + 0, q + n_, work_y_.data());
    std::copy(rate + 0, rate + n_, work_y_.data() + n_);
    return work_y_.data();
  }
  static PetscErrorCode second_order_residual(TS, PetscReal t, Vec u, Vec v, Vec a, Vec r, void *self)
  {
    PetscTs          &own = *static_cast<PetscTs *>(self);
    const ConstValues acceleration(a);
    own.form_.displacement_residual(t, own.joined(u, v), acceleration, Values(r));
    return 0;
  }
  static PetscErrorCode second_order_matrix(TS, PetscReal t, Vec u, Vec v, Vec, PetscReal shift_v, PetscReal shift_a,
                                            Mat, Mat, void *self)
  {
    PetscTs &own = *static_cast<PetscTs *>(self);
    own.form_.linearise(t, own.joined(u, v));
    return own.form_.factorise_displacements(shift_a, shift_v) ? 0 : PETSC_ERR_CONV_FAILED;
  }

  static PetscErrorCode solve(PC solver, Vec b, Vec x)
  {
    void *context = nullptr;
    PCShellGetContext(solver, &context);
    PetscTs &own = *static_cast<PetscTs *>(context);
    VecCopy(b, x);
    const Values values(x);
    if (own.second_order_)
      own.form_.solve_displacements(values);
    else
      own.form_.solve_residual_form(values);
    return 0;
  }

  FirstOrderForm    &form_;
  const bool         second_order_;
  const Eigen::Index n_;
  double             t_, t_before_;
  Eigen::VectorXd    y_, before_, work_y_;
  std::string        failure_;
  TS                 ts_     = nullptr;
  Mat                matrix_ = nullptr;
  Vec                u_ = nullptr, v_ = nullptr, output_ = nullptr, weights_ = nullptr;
};

} // namespace
} // namespace gestell::peers

extern "C" __attribute__((visibility("default"))) gestell::peers::Stepper *
gestell_petsc_stepper(gestell::peers::Callbacks *callbacks, const gestell::peers::PeerProblem *problem,
                      const gestell::peers::PeerOptions *options)
{
  return new gestell::peers::PetscTs(*callbacks, *problem, *options);
}
