#include "apps/scene/read/read_compliance.h"

namespace gestell::apps
{
namespace
{

/// One number for all directions, or three along the global axes.
Vector3 read_directed(const SceneTable &any, const std::string &key, const Kind &kind, ComplianceRequest &compliance)
{
  const SceneTable table = any.declared(compliance_keys());
  if (!table.is_array(key))
  {
    const double all = table.value(key);
    return {all, all, all};
  }
  compliance.directed   = true;
  const Vector3 numbers = table.vector(key, kind);
  for (const double number : numbers)
    if (number < 0.)
      throw table.error(key, "needs three values of zero or more");
  return numbers;
}

} // namespace

const std::vector<Key> &compliance_keys()
{
  static const std::vector<Key> keys = {
      key::number("stiffness", kind::stiffness,
                  "in every direction that the joint holds, or `[x, y, z]` along the global axes in the position "
                  "described, which then turn with `from`; 0 holds nothing")
          .from_zero()
          .also({Key::Form::vector})
          .by_default("ideal"),
      key::number("damping", kind::damping, "likewise").from_zero().also({Key::Form::vector}).by_default(0.),
      key::number("rotational_stiffness", kind::torsional_stiffness,
                  "about every axis that the joint holds; demanded where it yields and holds any: a pin of planar "
                  "bodies holds none, one of a rigid body two")
          .above_zero()
          .by_default("ideal"),
      key::number("rotational_damping", kind::torsional_damping, "likewise").from_zero().by_default("0")};
  return keys;
}

std::optional<ComplianceRequest> read_compliance(const SceneTable &table, JointType type)
{
  const char *given = nullptr;
  for (const char *key : {"rotational_damping", "rotational_stiffness", "damping", "stiffness"})
    if (table.has(key))
      given = key;
  if (!given)
    return std::nullopt;
  if (type == JointType::distance || type == JointType::gear || type == JointType::measure)
    throw table.error(given, "makes a joint of two places yield, not a \"" + table.text("type") +
                                 "\"; for that use a spring-damper `on` a [measure] of type " +
                                 (type == JointType::distance ? "\"distance\"" : "\"sum\" or \"position function\""));
  if (!table.has("stiffness"))
    throw table.error("needs 'stiffness' beside '" + std::string(given) + "'; a joint without any is ideal");
  if (table.has("friction"))
    throw table.error("friction", "is that of an ideal joint, whose force closes it; beside a compliant one put an "
                                  "element of type \"friction\", or use a \"journal bearing\"");
  ComplianceRequest compliance;
  compliance.stiffness = read_directed(table, "stiffness", kind::stiffness, compliance);
  compliance.damping   = read_directed(table, "damping", kind::damping, compliance);
  if (compliance.stiffness == Vector3{})
    throw table.error("stiffness", "is zero in every direction, so that the joint would hold nothing; leave it out");
  if (table.has("rotational_stiffness"))
    compliance.rotational_stiffness = table.declared(compliance_keys()).value("rotational_stiffness");
  if (table.has("rotational_damping"))
    compliance.rotational_damping = table.declared(compliance_keys()).value("rotational_damping");
  return compliance;
}

} // namespace gestell::apps
