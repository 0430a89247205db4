#pragma once

#include "coupling/reduction/reduce_frame.h"
#include "coupling/substructures/joined_parts.h"
#include "coupling/substructures/placed_part.h"
#include "fem/recovery/discretisation.h"
#include "tests/support/box_mesh.h"

#include <string>
#include <vector>

namespace gestell::test
{

/// A part with the mesh it is made of.
struct Piece
{
  std::string             name;
  fem::Mesh               mesh;
  fem::FrameSpecification geometry;
  coupling::Placement     placement{};
};

constexpr double part_length = 0.4, part_width = 0.1, part_height = 0.08;

/// A bar along x with an interface at each end: "rear" (x = 0) and "front".
inline Piece bar(const std::string &name, fem::InterfaceCoupling rear, fem::InterfaceCoupling front, double at = 0.,
                 int cells = 2)
{
  Piece piece{name, box_mesh({{cells, 1, 1}}, {{part_length, part_width, part_height}}), free_steel(), {}};
  piece.geometry.interfaces = {interface("rear", {"x0"}, rear), interface("front", {"x1"}, front)};
  piece.placement.at        = {at, 0., 0.};
  return piece;
}

/// Bars whose faces are flexible.
inline void make_flexible(Piece &piece, const std::string &interface, int degree)
{
  for (fem::InterfaceSpecification &own : piece.geometry.interfaces)
    if (own.name == interface)
    {
      own.coupling = fem::InterfaceCoupling::flexible;
      own.degree   = degree;
    }
}

inline coupling::FrameJoint weld(const std::string &name, const coupling::JointEnd &first,
                                 const coupling::JointEnd &second)
{
  coupling::FrameJoint joint;
  joint.name    = name;
  joint.between = {first, second};
  joint.place   = "frame.joint." + name;
  return joint;
}

inline coupling::FrameOfParts described(const std::vector<Piece> &pieces, std::vector<coupling::FrameJoint> joints)
{
  coupling::FrameOfParts frame;
  frame.place = "frame";
  for (const Piece &piece : pieces)
    frame.parts.push_back({piece.name, piece.geometry, piece.placement, "frame.part." + piece.name});
  frame.joints = std::move(joints);
  return frame;
}

/// Every mode there is.
constexpr int all_modes = -2;

inline coupling::ReductionOptions keeping(const fem::FrameMatrices &frame, int modes)
{
  coupling::ReductionOptions options;
  options.n_modes = modes == all_modes ? int(frame.M.rows()) - int(frame.interface_coordinates().size()) : modes;
  return options;
}

inline coupling::ReducedFrame reduced(const Piece &piece, int modes)
{
  const auto frame = fem::discretise(piece.mesh, piece.geometry);
  return coupling::placed(coupling::reduce_frame(frame, keeping(frame, modes)), piece.name, piece.placement);
}

inline coupling::JoinedParts joined(const std::vector<Piece> &pieces, const coupling::FrameOfParts &frame, int modes)
{
  std::vector<coupling::ReducedFrame> parts;
  for (const Piece &piece : pieces)
    parts.push_back(reduced(piece, modes));
  return coupling::join_parts(parts, frame);
}

/// The joined parts with every mode they have.
inline coupling::ReducedFrame whole(const std::vector<Piece> &pieces, coupling::FrameOfParts frame, int modes)
{
  frame.all_modes = true;
  const auto both = joined(pieces, frame, modes);
  return coupling::completed(coupling::reduce_frame(both.matrices, coupling::joined_options(frame, both, {})), both);
}

} // namespace gestell::test
