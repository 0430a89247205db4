#pragma once

#include "fem/values/frame_specification.h"

#include <functional>
#include <string>

namespace gestell::fem::test
{

/// Folder of this test program for files made on the fly.
std::string folder();

/// Path of a new file with this text.
std::string write_text(const std::string &name, const std::string &text);

std::string read_text(const std::string &path);

/// Path of a new CAD file (by its extension) with what `draw` draws with gmsh::model::occ.  gmsh writes STEP as mm.
std::string draw(const std::string &name, const std::function<void()> &draw);

/// The frame of the press of meshes/.
std::string press_frame();

/// A frame without surfaces; places as a scene would give them.
FrameSpecification specification(const std::string &cad, double size);

SurfaceSelector plane(Vector3 normal, Vector3 through, int faces = 1);
SurfaceSelector cylinder(Vector3 axis, Vector3 through, double radius, int faces = 1);
SurfaceSelector group(const std::string &name, int faces = 1);

/// Message of the std::invalid_argument that meshing throws; "" if it throws none.
std::string refusal(const FrameSpecification &specification);

} // namespace gestell::fem::test
