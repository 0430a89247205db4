#include "apps/study/file/event_kinds.h"

#include <algorithm>

namespace gestell::apps
{
namespace
{

bool ends_with(const std::string &word, const std::string &end)
{
  return word.size() > end.size() && word.compare(word.size() - end.size(), end.size(), end) == 0;
}

} // namespace

const std::vector<std::string> &event_kinds()
{
  static const std::vector<std::string> kinds{"braking_corner",
                                              "braking_ends",
                                              "conrod_close_compression",
                                              "conrod_close_tension",
                                              "conrod_leave_tension",
                                              "conrod_open",
                                              "contact",
                                              "contact_grip",
                                              "contact_negative",
                                              "contact_positive",
                                              "contact_slack",
                                              "delivery_closes",
                                              "delivery_opens",
                                              "drawn_through",
                                              "flow_begins",
                                              "fracture_branch_end",
                                              "lift_off",
                                              "limit_left",
                                              "limit_reached",
                                              "next_period",
                                              "next_segment",
                                              "orders",
                                              "previous_period",
                                              "previous_segment",
                                              "ready",
                                              "reversal",
                                              "separation",
                                              "sheet_severed",
                                              "slack",
                                              "slip_backward",
                                              "slip_forward",
                                              "stick",
                                              "suction_closes",
                                              "suction_opens",
                                              "switch",
                                              "taut",
                                              "tool_contact",
                                              "tool_force_maximum_passed",
                                              "tool_release",
                                              "tool_reload",
                                              "tool_unload",
                                              "touch_down"};
  return kinds;
}

bool is_event_kind(const std::string &word)
{
  return std::binary_search(event_kinds().begin(), event_kinds().end(), word) || ends_with(word, "_rises") ||
         ends_with(word, "_falls");
}

} // namespace gestell::apps
