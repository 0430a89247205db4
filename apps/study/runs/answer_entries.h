#pragma once

#include "apps/output/values/result.h"
#include "apps/scene/scene.h"

#include <string>
#include <vector>

namespace gestell::apps
{

/// A number of a run's answer with its unit.
struct AnswerValue
{
  double      value = 0.; ///< nan: an event that did not occur
  std::string unit{};
};

/**
 * Entries of a run's answer by their path in summary.json, in short forms where a number is meant:
 *
 *     signals.NAME.min | max | t_min | t_max | final | range
 *     events.NAME[.KIND][.first | last | count | 2]     the time [s]; how often
 *     modes.N, frequencies_hz.N                         frequency [Hz] of the machine's N-th mode, from 1
 *     energy.input ..., work.steps ..., model.frame_mass, stress. ...
 */
namespace answer_entry
{

/// The words with which an entry begins.
const std::vector<std::string> &tables();

/// Refuses what no run of the scene has, as far as that is known before one.
/// @throws std::invalid_argument: what is wrong, with the nearest name
void check(const std::vector<std::string> &segments, const Scene &scene);

/// @throws std::invalid_argument: the result has no such number
AnswerValue value(const std::vector<std::string> &segments, const Result &result);

} // namespace answer_entry
} // namespace gestell::apps
