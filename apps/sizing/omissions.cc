#include "apps/sizing/omissions.h"

#include "apps/scene/variant.h"
#include "fem/values/number_text.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace gestell::apps
{

namespace
{

constexpr double half     = 0.5; ///< of the tolerance, for each single omission
constexpr double as_rigid = 1e4; ///< times as stiff: what yields 1e-4 of before yields nothing that counts

/// The largest change of an output, of its scale.
struct Change
{
  double      share = 0.;
  std::string output;

  std::string text() const { return "changes " + output + " by " + short_text(100. * share, 2) + " %"; }
};

class Questions
{
public:
  Questions(const QuestionedModel &model, const std::atomic<bool> *stop) : model_(model), stop_(stop) {}

  Omissions all()
  {
    gravity();
    elements();
    joint_friction();
    untouched_branches();
    rigid_springs();
    rigid_frame();
    kinds_of_interfaces();
    fast_loads();
    return std::move(found_);
  }

private:
  /// Change with another scene; null if it cannot be run: other parts depend on the omitted one.
  std::optional<Change> change(Scene other, const ModelAnswer &than) const;
  void                  may_be_left_out(const std::string &what, const Scene &without);
  bool                  may_ask(const std::string &what, double cpu);
  /// Tries the scene with each member of a list changed.
  template <typename List, typename Act>
  void each(List Scene::*list, const Act &act)
  {
    for (std::size_t i = 0; i < (model_.scene.*list).size(); ++i)
    {
      Scene       other = model_.scene;
      std::string what  = act(other, i);
      if (!what.empty())
        may_be_left_out(what, other);
    }
  }

  void gravity();
  void elements();
  void joint_friction();
  void untouched_branches();
  void rigid_springs();
  void rigid_frame();
  void kinds_of_interfaces();
  void fast_loads();

  const QuestionedModel   &model_;
  const std::atomic<bool> *stop_;
  Omissions                found_;
};

/// Else it is named.
bool Questions::may_ask(const std::string &what, double cpu)
{
  const bool may = !model_.affords || model_.affords(cpu);
  if (!may)
    found_.unasked.push_back(what);
  return may;
}

std::optional<Change> Questions::change(Scene other, const ModelAnswer &than) const
{
  keep_signals(other, signals_of(model_.outputs)); // others may read an omitted part
  try
  {
    const ModelAnswer answer = answer_of(other, {}, model_.outputs, stop_);
    Change            change;
    for (std::size_t i = 0; i < model_.outputs.size(); ++i)
      if (const double share = std::abs(answer.values[i] - than.values[i]) / model_.scales[i]; share >= change.share)
        change = {share, model_.outputs[i].text};
    return change;
  }
  catch (const std::exception &)
  {
    if (stop_ && *stop_)
      throw;
    return std::nullopt;
  }
}

void Questions::may_be_left_out(const std::string &what, const Scene &without)
{
  if (!may_ask(what, model_.answer.run_cpu))
    return;
  if (const auto changed = change(without, model_.answer); changed && changed->share <= half * model_.tolerance)
    found_.left_out.push_back(what + ": " + changed->text());
}

void Questions::gravity()
{
  if (model_.scene.gravity == Vector3{})
    return;
  Scene without   = model_.scene;
  without.gravity = {};
  may_be_left_out("gravity", without);
}

void Questions::elements()
{
  const auto without = [](auto &list, std::size_t i)
  {
    const std::string name = list[i].name;
    list.erase(list.begin() + std::ptrdiff_t(i));
    return "element \"" + name + '"';
  };
  each(&Scene::elements, [&](Scene &other, std::size_t i) { return without(other.elements, i); });
  each(&Scene::linear, [&](Scene &other, std::size_t i) { return without(other.linear, i); });
}

void Questions::joint_friction()
{
  each(&Scene::joints,
       [](Scene &other, std::size_t i) -> std::string
       {
         if (!other.joints[i].friction)
           return "";
         other.joints[i].friction.reset();
         return "friction in joint \"" + other.joints[i].name + '"';
       });
}

/// Play that never opens, a stop that is never reached: its law is smooth in this run.
void Questions::untouched_branches()
{
  for (const ElementRequest &element : model_.scene.elements)
  {
    const bool touched  = std::any_of(model_.answer.events.begin(), model_.answer.events.end(),
                                      [&](const coupling::Event &event) { return event.name == element.name; });
    const bool branches = element.element && element.element->branches();
    if (branches && !touched && model_.scene.run.options.events)
      found_.left_out.push_back("play, stops or sticking of \"" + element.name +
                                "\": no event in the run, so only one branch of its law is used");
  }
}

void Questions::rigid_springs()
{
  each(&Scene::linear,
       [](Scene &other, std::size_t i) -> std::string
       {
         if (!(other.linear[i].stiffness > 0.))
           return "";
         other.linear[i].stiffness *= as_rigid;
         return "elasticity of \"" + other.linear[i].name + '"';
       });
}

void Questions::rigid_frame()
{
  const std::string what = "elasticity of the frame";
  if (model_.scene.frame.source != FrameSource::geometry || !may_ask(what, model_.coarse_answer.cpu()))
    return;
  Scene                    rigid = model_.coarse;
  fem::FrameSpecification &frame = rigid.frame.geometry;
  frame.material.E *= as_rigid;
  for (auto &material : frame.materials)
    material.second.E *= as_rigid;
  const auto changed = change(rigid, model_.coarse_answer);
  if (changed && changed->share <= half * model_.tolerance)
    found_.left_out.push_back(what + ": " + changed->text());
}

/// Tries both kinds of every interface: a wall softer than its rigid surface, and one whose elasticity has no effect.
void Questions::kinds_of_interfaces()
{
  const auto &interfaces = model_.scene.frame.geometry.interfaces;
  if (model_.scene.frame.source != FrameSource::geometry)
    return;
  for (std::size_t i = 0; i < interfaces.size(); ++i)
  {
    const bool rigid = interfaces[i].coupling == fem::InterfaceCoupling::rigid;
    if (!rigid && interfaces[i].coupling != fem::InterfaceCoupling::average)
      continue;
    if (!may_ask("the wall of interface \"" + interfaces[i].name + '"', model_.coarse_answer.cpu()))
      continue;
    Scene other = model_.coarse;
    other.frame.geometry.interfaces[i].coupling =
        rigid ? fem::InterfaceCoupling::average : fem::InterfaceCoupling::rigid;
    const auto changed = change(other, model_.coarse_answer);
    if (rigid && changed && changed->share > model_.tolerance)
      found_.missing.push_back("the wall of interface \"" + interfaces[i].name +
                               "\": it is rigid, and coupling = \"average\" " + changed->text());
    if (!rigid && changed && changed->share <= half * model_.tolerance)
      found_.left_out.push_back("elasticity of the wall of interface \"" + interfaces[i].name +
                                "\": coupling = \"rigid\" " + changed->text());
  }
}

void Questions::fast_loads()
{
  const Eigen::VectorXd &omega  = model_.answer.omega;
  const double           cutoff = omega.size() > 0 ? omega[omega.size() - 1] / (2. * M_PI) : 0.;
  if (!modes_are_chosen(model_.scene) || !(cutoff > 0.))
    return;
  for (const LoadRequest &load : model_.scene.loads)
  {
    double highest = 0.;
    for (const auto &harmonic : load.oscillations)
      highest = std::max(highest, harmonic.omega / (2. * M_PI));
    constexpr double near_cutoff = 1.5; // times a frequency of a load: modes up to there answer to it
    if (near_cutoff * highest > cutoff)
      found_.missing.push_back("modes above " + short_text(cutoff, 3) + " Hz, the highest retained one: \"" +
                               load.name + "\" acts with " + short_text(highest, 3) + " Hz");
  }
}

} // namespace

Omissions find_omissions(const QuestionedModel &model, const std::atomic<bool> *stop)
{
  return Questions(model, stop).all();
}

} // namespace gestell::apps
