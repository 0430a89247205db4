#include "apps/reference/synonyms.h"

namespace gestell::apps
{

const std::vector<Synonym> &synonyms()
{
  static const std::vector<Synonym> all = {
      {"backlash", {"element.gear pair", "element.clearance"}},
      {"ball bearing", {"element.rolling bearing", "element.journal bearing"}},
      {"bearing", {"joint.revolute", "element.rolling bearing", "element.journal bearing", "body.rotor"}},
      {"bolster", {"frame.interface"}},
      {"bushing", {"element.journal bearing", "joint.revolute"}},
      {"cable", {"element.rope"}},
      {"cam", {"joint.position function", "measure.position function"}},
      {"coupling", {"element.spring-damper", "element.clutch", "element.clearance"}},
      {"crank", {"body.rotor", "element.connecting rod", "joint.revolute"}},
      {"cylinder", {"element.hydraulic cylinder", "joint.distance"}},
      {"damper", {"element.spring-damper"}},
      {"drive",
       {"element.asynchronous motor", "element.dynamic motor", "element.speed drive", "joint.prescribed motion"}},
      {"flywheel", {"body.rotor"}},
      {"foundation", {"frame.support"}},
      {"gear", {"element.gear pair", "joint.gear", "joint.gear mesh", "measure.gear mesh"}},
      {"gib", {"element.guide with play", "joint.prismatic", "element.clearance"}},
      {"guide", {"joint.prismatic", "element.guide with play", "body.slider"}},
      {"hinge", {"joint.revolute"}},
      {"indexer", {"joint.position function"}},
      {"motor", {"element.asynchronous motor", "element.dynamic motor", "element.speed drive"}},
      {"mount", {"element.spring-damper", "frame.support"}},
      {"pin", {"joint.revolute", "element.journal bearing"}},
      {"piston", {"body.slider", "element.gas force", "element.hydraulic cylinder"}},
      {"pulley", {"element.belt"}},
      {"ram", {"body.slider", "element.hydraulic cylinder"}},
      {"rod", {"element.connecting rod", "body.planar", "body.rigid", "joint.distance"}},
      {"shaft", {"body.rotor", "element.spring-damper"}},
      {"slide", {"body.slider", "joint.prismatic"}},
      {"spindle", {"joint.screw", "body.rotor"}},
      {"spring", {"element.spring-damper", "element.cubic spring", "element.table force"}},
      {"sprocket", {"element.chain"}},
      {"tool", {"element.blanking force", "element.cutting force", "element.drawing force"}},
      {"toothed belt", {"element.belt"}},
      {"tyre", {"element.wheel"}},
      {"worm", {"joint.gear", "joint.screw"}},
  };
  return all;
}

} // namespace gestell::apps
