#include "apps/study/runs/study_answer.h"
#include "tests/support/program.h"
#include "tests/support/reference_table.h"

namespace gestell::tests
{
namespace
{

using namespace apps;

// The reference is good to about 1e-6 relative; of wheel forces the scale is that at standstill, 22 kN.
TEST(CraneBraking, MeetsTheReferenceFor98Runs)
{
  const std::atomic<bool> never{false};
  const Folder            folder("crane_braking");
  const StudyFile         study  = read_study(GESTELL_SOURCE_DIR "/apps/studies/crane_braking.toml", {});
  const StudyPoints       points = read_design(study);
  StudyRunner             runner(study, points.levels, fem::Scripts::harmless, {});
  StudyCall               call;
  call.folder                = folder.results();
  call.stop                  = &never;
  const StudyTable table     = make_study(study, points, runner, call).table;
  const auto       reference = read_reference("../crane/braking_study.csv");
  ASSERT_EQ(table.n_done(), 98);
  ASSERT_EQ(reference.size(), 98u);
  const std::vector<std::pair<std::string, std::string>> columns = {
      {"t_trigger", "t_trigger"}, {"max_F_v", "max_F_v"},      {"max_Q4", "max_Q4"},        {"t_max_Q4", "t_max_Q4"},
      {"max_x_L", "max_x_L"},     {"q4_end", "q4_end"},        {"beta_end", "beta_end"},    {"M_tip_end", "M_tip_end"},
      {"nu_end", "nu_end"},       {"T_brake", "braking_time"}, {"max_abs_q3", "max_abs_q3"}};
  for (int run = 0; run < 98; ++run)
  {
    const ReferenceRow &row   = reference[std::size_t(run)];
    const auto          value = [&](const std::string &name) { return table.values(run, table.output_index(name)); };
    ASSERT_EQ(value("tipped"), row.number("tipped")) << run + 1;
    EXPECT_NEAR(value("min_F_h"), row.number("min_F_h"), 22e-3) << run + 1;
    if (value("tipped") != 0.)
      continue; // the reference stops there
    EXPECT_EQ(value("liftoffs"), row.number("n_liftoff_rear")) << run + 1;
    for (const auto &[theirs, ours] : columns)
      EXPECT_NEAR(value(ours) / row.number(theirs), 1., 1e-6) << ours << " of run " << run + 1;
  }
}

} // namespace
} // namespace gestell::tests
