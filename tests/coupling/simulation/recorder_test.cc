// What is told of a run: extremes between the steps, rows and pictures on grids of their own.

#include "coupling/simulation/recorder.h"
#include "tests/support/test.h"

namespace
{

using namespace gestell::coupling;

constexpr double omega = 7., mass = 2.;

/// One slider of 2 kg that nothing holds.
Machine slider()
{
  MachineModel model;
  model.add_slider("x", {1., 0., 0.}, mass, "ground");
  return Machine(std::move(model));
}

/// Steps of h on the exact motion q = sin(omega t): whatever is told wrongly, the recorder does it.
class ExactSine : public TimeIntegrator
{
public:
  explicit ExactSine(double step) : step_(step)
  {
    now_.q.setZero(1);
    now_.v.setZero(1);
  }

  void begin(double t, const Eigen::VectorXd &, const Eigen::VectorXd &) override { at(begin_ = t); }
  void advance() override
  {
    begin_ = now_.t;
    at(begin_ + step_);
  }
  const LocalState &local() const override { return now_.local; }
  const Instant    &instant() const override { return now_; }
  double            step_begin() const override { return begin_; }
  void              interpolate(double t, LocalState &state) const override { state.t = t; }
  void              interpolate(double t, Eigen::VectorXd &q, Eigen::VectorXd &v) const override
  {
    q[0] = std::sin(omega * t);
    v[0] = omega * std::cos(omega * t);
  }
  void                   cut(double t) override { at(t); }
  void                   restart() override { begin_ = now_.t; }
  const IntegrationWork &work() const override { return work_; }

private:
  void at(double t)
  {
    interpolate(t, now_.q, now_.v);
    now_.t = now_.local.t = t;
  }

  double          step_, begin_ = 0.;
  Instant         now_;
  IntegrationWork work_;
};

RunResult recorded(double step, bool inside, double end, double output_step = 0., const StateRequest &states = {},
                   double event = -1.)
{
  const Machine             machine = slider();
  const std::vector<Signal> signals = {machine.signal("x", "x.displacement"), machine.signal("v", "x.velocity")};
  ExactSine                 sine(step);
  RunOptions                options;
  options.method.step  = step;
  options.end          = end;
  options.output_step  = output_step;
  options.picture_step = output_step;
  options.states       = states;
  RunResult result;
  Recorder  recorder(machine, sine, options, signals, {inside}, result);
  sine.begin(0., {}, {});
  recorder.begin();
  while (sine.time() < end - 1e-12)
  {
    sine.advance();
    if (sine.time() > end)
      sine.cut(end);
    const bool happens = sine.step_begin() < event && event < sine.time();
    if (happens)
      sine.cut(event);
    recorder.step();
    if (happens)
    {
      recorder.event({event, "rod", "contact"});
      sine.restart();
    }
  }
  recorder.finish(result);
  return result;
}

TEST(Recorder, FindsThePeakOfASineBetweenShortSteps)
{
  // Without it a peak in the middle of two ends would be short by (omega h)^2/8.
  for (const double wh : {0.6, 0.3, 0.15, 0.0301})
  {
    const RunResult result = recorded(wh / omega, false, 2.);
    EXPECT_NEAR(result.signals[0].max, 1., 1e-10) << wh;
    EXPECT_NEAR(result.signals[0].min, -1., 1e-10) << wh;
    EXPECT_NEAR(std::sin(omega * result.signals[0].t_max), 1., 1e-10) << wh;
    EXPECT_NEAR(result.signals[1].min, -omega, 1e-10 * omega) << wh;
  }
}

TEST(Recorder, FindsThePeaksInsideLongStepsToTheAccuracyOfTheDenseOutput)
{
  for (const double wh : {1.1, 1.9, 3.2, 40.}) // half a period in a step and more
  {
    const RunResult result = recorded(wh / omega, true, 3.);
    EXPECT_NEAR(result.signals[0].max, 1., 1e-10) << wh;
    EXPECT_NEAR(result.signals[0].min, -1., 1e-10) << wh;
    EXPECT_NEAR(result.signals[1].max, omega, 1e-10 * omega) << wh;
    EXPECT_NEAR(result.signals[1].min, -omega, 1e-10 * omega) << wh;
    EXPECT_NEAR(std::sin(omega * result.signals[0].t_max), 1., 1e-10) << wh;
  }
}

TEST(Recorder, KeepsValuesAndRatesAtAnEventHoweverFarApartRowsAre)
{
  const double    event = 0.347, step = 0.01;
  const RunResult result = recorded(step, false, 2., 0.5, {}, event);
  ASSERT_EQ(result.event_values.size(), 1u);
  const EventValues &at = result.event_values[0];
  EXPECT_EQ(at.t, event);
  EXPECT_NEAR(at.before[0], std::sin(omega * event), 1e-14);
  EXPECT_EQ(at.before, at.after); // nothing jumps
  // A parabola over two steps errs by a third of the third derivative times h^2 in its rate, and no more than that.
  EXPECT_NEAR(at.rate[0], omega * std::cos(omega * event), std::pow(omega, 3) * step * step / 3.);
}

TEST(Recorder, TakesRowsAndPicturesFromTheDenseOutputWhereNoStepEnds)
{
  const RunResult result = recorded(0.03, false, 0.505, 0.01);
  ASSERT_EQ(result.rows.size() % 6, 0u);  // t, x, v and three energies
  ASSERT_EQ(result.rows.size() / 6, 52u); // 0, 0.01 .. 0.5 and the end
  for (std::size_t row = 0; row < 52; ++row)
  {
    const double t = result.rows[6 * row];
    EXPECT_NEAR(t, row < 51 ? 0.01 * double(row) : 0.505, 1e-15);
    EXPECT_NEAR(result.rows[6 * row + 1], std::sin(omega * t), 1e-14);
    EXPECT_NEAR(result.rows[6 * row + 4], 0.5 * mass * omega * omega * (std::pow(std::cos(omega * t), 2) - 1.), 1e-12);
  }
  ASSERT_EQ(result.picture_times.size(), 51u);
  EXPECT_NEAR(result.picture_states[7][0], std::sin(omega * 0.07), 1e-14);
  EXPECT_NEAR(result.signals[0].final, std::sin(omega * 0.505), 1e-14);
}

TEST(Recorder, PicturesShowTheEventAndFollowCloselyAfterIt)
{
  const RunResult result = recorded(0.03, false, 1., 0.1, {}, 0.333);
  // 0, 0.1 .. 0.3, the event, eight to a step from 0.3375 to 0.725 and 0.8, 0.9, 1
  ASSERT_EQ(result.picture_times.size(), 4u + 1u + 32u + 3u);
  EXPECT_EQ(result.picture_times[4], 0.333);
  EXPECT_NEAR(result.picture_times[5], 0.3375, 1e-12);
  EXPECT_NEAR(result.picture_times[36], 0.725, 1e-12);
  EXPECT_EQ(result.picture_times.back(), 1.);
  ASSERT_EQ(result.picture_velocities.size(), result.picture_times.size());
  for (std::size_t k = 0; k < result.picture_times.size(); ++k)
  {
    EXPECT_NEAR(result.picture_states[k][0], std::sin(omega * result.picture_times[k]), 1e-12);
    EXPECT_NEAR(result.picture_velocities[k][0], omega * std::cos(omega * result.picture_times[k]), 1e-12);
  }
}

TEST(Recorder, RowsDoNotDependOnTheStep)
{
  const RunResult fine = recorded(0.003, false, 0.4, 0.02), coarse = recorded(0.07, true, 0.4, 0.02);
  ASSERT_EQ(fine.rows.size(), coarse.rows.size());
  for (std::size_t i = 0; i < fine.rows.size(); ++i)
    EXPECT_NEAR(fine.rows[i], coarse.rows[i], 1e-11);
}

TEST(Recorder, KeepsStatesOnAGridAtInstantsAndWhereSignalsAreExtreme)
{
  StateRequest states;
  states.step          = 0.03;
  states.at            = {0., 0.1234, 2.};
  states.extremes      = {{0, true}, {1, false}};
  const RunResult kept = recorded(0.05, false, 2., 0., states);

  ASSERT_EQ(kept.states.grid.size(), 67u); // 0, 0.03, ..., 1.98
  for (std::size_t k = 0; k < kept.states.grid.size(); ++k)
  {
    EXPECT_NEAR(kept.states.grid[k].t, 0.03 * double(k), 1e-14);
    EXPECT_NEAR(kept.states.grid[k].q[0], std::sin(omega * 0.03 * double(k)), 1e-12);
  }
  for (int i = 0; i < 3; ++i)
    EXPECT_NEAR(kept.states.at[i].q[0], std::sin(omega * states.at[i]), 1e-12) << states.at[i];
  EXPECT_EQ(kept.states.extremes[0].t, kept.signals[0].t_max);
  EXPECT_NEAR(kept.states.extremes[0].q[0], kept.signals[0].max, 1e-12)
      << "the state belongs to the peak between steps";
  EXPECT_EQ(kept.states.extremes[1].t, kept.signals[1].t_min);
  EXPECT_NEAR(kept.states.extremes[1].q[0], std::sin(omega * kept.signals[1].t_min), 1e-12);
}

TEST(Recorder, LeavesInstantsEmptyThatWereNotReached)
{
  StateRequest states;
  states.at            = {0.5, 3.};
  const RunResult kept = recorded(0.05, false, 2., 0., states);
  EXPECT_EQ(kept.states.at[0].q.size(), 1);
  EXPECT_EQ(kept.states.at[1].q.size(), 0);
  EXPECT_TRUE(recorded(0.05, false, 2.).states.grid.empty());
}

} // namespace
