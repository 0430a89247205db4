#include "apps/analysis/analysis_entry.h"
#include "apps/analysis/life/life_charts.h"
#include "apps/analysis/life/life_damage.h"
#include "apps/analysis/life/life_rules.h"
#include "apps/analysis/life/life_skin.h"
#include "apps/analysis/life/life_states.h"
#include "apps/analysis/life/life_twins.h"
#include "apps/analysis/life/life_warnings.h"
#include "apps/analysis/life/weld_points.h"
#include "apps/session/sensitivity/sensitivity_keys.h"

#include "fem/values/number_text.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>

namespace gestell::apps
{
namespace
{

/// Damage over the picture: in colours from a ten-thousandth of the largest.
void show_field(const LifeResult &found, Scenery &scenery)
{
  const double most =
      found.field.damage.empty() ? 0. : *std::max_element(found.field.damage.begin(), found.field.damage.end());
  if (!(most > 0.) || found.field.damage.size() != scenery.points.size())
    return;
  std::vector<double> shades;
  for (const double damage : found.field.damage)
    shades.push_back(shade_of(damage, most));
  scenery.fields.push_back({"damage", "damage",
                            "damage " + short_text(most * std::pow(10., -shaded_decades), 2) + " to " +
                                short_text(most, 2) + ", logarithmic",
                            std::move(shades), found.worst()->at});
}

/// Fatigue of the frame under the motion of a run.
class Life : public Analysis
{
public:
  std::vector<CommandOption> options() override
  {
    return {
        {"--life-error", &refine_, "errors of the life by modes and time from two further, finer runs"},
        {"--life-by", &keys_,
         "derivatives d ln(life)/d ln(key) by scene parameters, such as parameters.c_P,parameters.s_cl: four further, "
         "finer runs each"}};
  }

  void open(std::string &input, std::vector<std::string> &changes, std::string &folder) override
  {
    namespace fs = std::filesystem;
    if (!fs::is_directory(input))
    {
      if (!fs::exists(input) && fs::path(input).extension() != ".toml")
        throw std::invalid_argument(input + ": there is no such scene or folder; " +
                                    kept_folders(fs::path(input).parent_path()));
      return;
    }
    kept_ = kept_life(input, changes);
    if (folder.empty())
      folder = fs::proximate(fs::canonical(input).string() + "_life").string();
    input   = kept_->scene;
    changes = kept_->changes;
  }
  bool                     computes_run() const override { return !kept_; }
  std::vector<std::string> reads() const override { return {kept_ ? kept_->file.string() : ""}; }

  bool requested(const Scene &scene) const override { return scene.life != nullptr; }
  void check(Session &session) override
  {
    const Scene &scene = session.scene();
    if (!scene.life)
      throw std::invalid_argument(scene.file + ": there is no [life]; give it a curve, such as curve = { class = 71 }");
    check_keys(session);
    const LifeRequest &life = *scene.life;
    if (!life.curve.place.empty())
      damage_rule(life, life.curve, StressKind::direct);
    for (const WeldRequest &weld : life.welds)
      damage_rule(life, weld.curve.value_or(life.curve), weld.shear ? StressKind::shear : StressKind::direct);
    for (const BlockRequest &block : life.blocks)
    {
      std::error_code none; // without a file the scene is of a calling program
      if (std::filesystem::equivalent(block.file, scene.file, none))
        throw std::invalid_argument(block.place + ": names its own scene, the first block; increase life.repetitions");
      block_scene(session.variant(), block);
    }
  }
  /// Checks what needs the frame, before the run costs time.
  void before_motion(RunInProgress &run) override
  {
    const Scene                  &scene = run.session.scene();
    const coupling::ReducedFrame *frame = run.session.machine().machine.model().reduced_frame();
    if (!frame || frame->stress.empty())
      throw std::invalid_argument(scene.life->place +
                                  ": the reduced frame was written without stresses; write it again "
                                  "by `gestell reduce` of a scene with [life]");
    const LifeSkin skin = skin_of(*frame);
    for (const WeldRequest &weld : scene.life->welds)
      weld_points(weld, scene.frame.geometry.surfaces, frame->stress, skin);
    check_blocks(run.session);
  }
  /// A failure leaves the run intact; a run that stopped early has no life.
  AnalysisOutcome compute(Session &session, Result &result) const override
  {
    const Scene &scene = session.scene();
    if ((result.run && (!result.run->failure.empty() || result.run->interrupted)) || !scene.life)
      return AnalysisOutcome::done;
    session.progress()("life", -1.);
    try
    {
      const coupling::ReducedFrame &frame = *session.machine().machine.model().reduced_frame();
      const auto load = std::make_shared<LifeLoad>(kept_ ? load_of(*kept_, session) : life_load(session, *result.run));
      const auto before = std::clock();
      LifeResult found  = life_of(scene, frame, *load);
      found.cpu_s       = double(std::clock() - before) / CLOCKS_PER_SEC;
      if (!kept_)
        found.states = life_states_bin(session.variant(), frame, load);
      if (refine_)
        refine_error(session, *load, found);
      if (!keys_.empty())
        found.derivatives = life_derivatives(session, found, keys_);
      const auto warnings = life_warnings(scene, found);
      result.warnings.insert(result.warnings.end(), warnings.begin(), warnings.end());
      show_field(found, result.scenery);
      result.answers.push_back(as_answer(std::move(found)));
      return AnalysisOutcome::done;
    }
    catch (const std::runtime_error &failure)
    {
      result.warnings.push_back("there is no life: " + std::string(failure.what()));
      return session.interruption() && *session.interruption() ? AnalysisOutcome::interrupted : AnalysisOutcome::failed;
    }
  }

private:
  void check_keys(Session &session) const
  try
  {
    if (!keys_.empty())
      varied_keys(session.variant().root, keys_);
  }
  catch (const std::invalid_argument &error)
  {
    std::string       text  = error.what();
    const std::string other = "--sensitivities";
    throw std::invalid_argument(text.rfind(other, 0) == 0 ? "--life-by" + text.substr(other.size()) : text);
  }

  bool                    refine_ = false;
  std::string             keys_;
  std::optional<KeptLife> kept_;
};

} // namespace

AnalysisEntry life_analysis()
{
  return analysis_entry<Life, LifeResult>(
      "life",
      "compute the fatigue damage of the frame and the places where it cracks first; for a result folder in place of a "
      "scene, count its states again with other keys of [life]",
      {"gestell life apps/scenes/press.toml --set life.curve.class=71",
       "gestell life results/press --set life.curve.class=63"},
      {{"life.csv", "worst places with damage and life, with `[life]`", content_of<LifeResult, life_places_csv>},
       {"life_cycles.csv", "cycles at the worst place, by damage", content_of<LifeResult, life_cycles_csv>},
       {"life.vtp",
        "damage and life on the frame in ParaView, as logarithms; a tenth of the smallest damage where there is none",
        content_of<LifeResult, life_vtp>},
       {life_states_file, "states of the frame, from which `gestell life FOLDER` counts again",
        [](const Result &result)
        {
          const auto *found = answer_in<LifeResult>(result.answers);
          return found && found->states ? found->states() : "";
        }}},
      "run");
}

} // namespace gestell::apps
