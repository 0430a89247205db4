// ARKODE's explicit Runge-Kutta methods behind Stepper.

#include "apps/peers/sundials.h"

#include <arkode/arkode_erkstep.h>

namespace gestell::peers
{
namespace
{

int rate(double t, N_Vector y, N_Vector y_rate, void *user)
{
  static_cast<Callbacks *>(user)->form.rate(t, values(y), values(y_rate));
  return 0;
}

int guards(double t, N_Vector y, double *g, void *user)
{
  static_cast<Callbacks *>(user)->guards(t, values(y), g);
  return 0;
}

/// Embedded pairs: Bogacki-Shampine 3(2), Zonneveld 4(3), Dormand-Prince 5(4), Verner 6(5), Fehlberg 8(7).
ARKODE_ERKTableID table(int order)
{
  switch (order)
  {
  case 3:
    return ARKODE_BOGACKI_SHAMPINE_4_2_3;
  case 4:
    return ARKODE_ZONNEVELD_5_3_4;
  case 6:
    return ARKODE_VERNER_8_5_6;
  case 8:
    return ARKODE_FEHLBERG_13_7_8;
  default:
    return ARKODE_DORMAND_PRINCE_7_4_5;
  }
}

class ExplicitRk : public Stepper
{
public:
  ExplicitRk(Callbacks &callbacks, const PeerProblem &problem, const PeerOptions &options)
      : parts_(callbacks, problem, options, false), output_(parts_.vector()), t_(problem.t),
        end_(problem.samples.back())
  {
    memory_ = ERKStepCreate(rate, problem.t, parts_.y, parts_.context);
    ERKStepSetErrHandlerFn(memory_, keep_message, &parts_.failure);
    ERKStepSetUserData(memory_, &callbacks);
    ERKStepSetTableNum(memory_, table(options.order));
    ERKStepSetMaxNumSteps(memory_, -1);
    ERKStepSetMaxHnilWarns(memory_, -1);
    expect(ERKStepSVtolerances(memory_, options.tolerance, parts_.weights), "ERKStepSVtolerances");
  }
  ~ExplicitRk() override { ERKStepFree(&memory_); }

  Outcome step() override
  {
    const int code = ERKStepEvolve(memory_, end_, parts_.y, &t_, ARK_ONE_STEP);
    return code < 0 ? Outcome::failed : code == ARK_ROOT_RETURN ? Outcome::root : Outcome::step;
  }
  double        time() const override { return t_; }
  const double *state() const override { return values(parts_.y); }
  void          interpolate(double t, double *y) override
  {
    ERKStepGetDky(memory_, t, 0, output_);
    std::copy(values(output_), values(output_) + N_VGetLength(output_), y);
  }
  void restart(double t, const double *y) override
  {
    count(past_);
    t_ = t;
    std::copy(y, y + N_VGetLength(parts_.y), values(parts_.y));
    expect(ERKStepReInit(memory_, rate, t, parts_.y), "ERKStepReInit");
  }
  void watch(const std::vector<int> &directions) override
  {
    found_.assign(directions.size(), 0);
    expect(ERKStepRootInit(memory_, 0, nullptr), "ERKStepRootInit");
    expect(ERKStepRootInit(memory_, int(directions.size()), guards), "ERKStepRootInit");
    std::vector<int> copy = directions;
    if (!copy.empty())
      expect(ERKStepSetRootDirection(memory_, copy.data()), "ERKStepSetRootDirection");
    ERKStepSetNoInactiveRootWarn(memory_);
  }
  int root() override
  {
    ERKStepGetRootInfo(memory_, found_.data());
    for (std::size_t i = 0; i < found_.size(); ++i)
      if (found_[i] != 0)
        return int(i);
    return 0;
  }
  void count(coupling::IntegrationWork &work) override
  {
    long steps = 0, rejected = 0;
    ERKStepGetNumSteps(memory_, &steps);
    ERKStepGetNumErrTestFails(memory_, &rejected);
    work.steps += steps;
    work.rejected += rejected;
    if (&work == &past_)
      return;
    work.steps += past_.steps, work.rejected += past_.rejected;
  }
  const std::string &failure() const override { return parts_.failure; }

private:
  SundialsParts             parts_;
  N_Vector                  output_;
  void                     *memory_ = nullptr;
  double                    t_, end_;
  std::vector<int>          found_;
  coupling::IntegrationWork past_; ///< before the last restart, as ARKODE begins to count anew
};

} // namespace

std::unique_ptr<Stepper> make_explicit_rk(Callbacks &callbacks, const PeerProblem &problem, const PeerOptions &options)
{
  return std::make_unique<ExplicitRk>(callbacks, problem, options);
}

} // namespace gestell::peers
