#pragma once

#include "apps/output/folder/own_folder.h"
#include "apps/output/values/result.h"

#include <string>
#include <vector>

namespace gestell::apps
{

/// Forces in saved state k of the run; empty: there are none, or they are not known.
std::vector<ActingForce> forces_at(const Result &result, std::size_t k);

/// forces.pvd: a point where each element acts on each body, with "force [N]" and "torque [N m]" on that body, its
/// "body" and "element", at the times of motion.pvd.
/// @param pictures  indices of the saved states that are written
/// @param names     receives the names of the files
void write_force_files(OwnFolder &folder, const Result &result, const std::vector<std::size_t> &pictures,
                       std::vector<std::string> &names);

} // namespace gestell::apps
