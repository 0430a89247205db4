#pragma once

#include "fem/values/frame_matrices.h"
#include "fem/values/frame_specification.h"
#include "fem/values/mesh.h"
#include "tests/support/refusal.h"

#include <array>

namespace gestell::test
{

/**
 * Box [0, size] of n bricks, each cut into six tetrahedra along its diagonal (Kuhn).  Surfaces "x0", "x1", "y0", "y1",
 * "z0", "z1" are its sides.
 *
 * @param distortion inner points are moved by up to this share of a brick, so that no two cells are alike.
 */
fem::Mesh box_mesh(const std::array<int, 3> &n, const std::array<double, 3> &size, double distortion = 0.);

/// Steel, no supports, no interfaces.
fem::FrameSpecification free_steel();

fem::Support                clamped(const std::string &name, const std::vector<std::string> &surfaces,
                                    const std::array<bool, 3> &held = {{true, true, true}});
fem::Support                foundation(const std::string &name, const std::vector<std::string> &surfaces,
                                       const fem::Vector3 &stiffness, const fem::Vector3 &damping = {});
fem::InterfaceSpecification interface(const std::string &name, const std::vector<std::string> &surfaces,
                                      fem::InterfaceCoupling coupling);

const fem::FrameOutput &output(const fem::FrameMatrices &frame, const std::string &name);

using tests::expect_refusal;
using tests::refusal;

} // namespace gestell::test
