#include "apps/commands/commands.h"
#include "apps/output/number_text.h"
#include "apps/scene/build_machine.h"
#include "coupling/frame_service_loader.h"
#include "coupling/mesh_service.h"

#include <iostream>
#include <string>
#include <vector>

namespace gestell::apps
{

namespace
{

/// Reads the frame's file and finds its surfaces, where this build can.  @return what was found
std::string try_geometry(const fem::FrameSpecification &frame, std::vector<std::string> &warnings)
{
  if (!coupling::has_frame_service())
    return frame.cad + " is there; this build cannot read it";
  const auto [found, notes] = coupling::mesh_service().inspect(frame);
  warnings.insert(warnings.end(), notes.begin(), notes.end());
  return frame.cad + ": " + found + "; not meshed";
}

} // namespace

int check_command(const CommonOptions &options)
{
  const Scene scene = read_scene(options.input, options.overrides);
  check_scene(scene);
  std::vector<std::string> warnings = scene.warnings;
  std::string              geometry;
  if (scene.frame.source == FrameSource::geometry)
    geometry = try_geometry(scene.frame.geometry, warnings);
  std::cout << scene.file << ": the scene \"" << scene.name
            << "\" is well formed: " << count_text(scene.bodies.size(), "body", "bodies") << ", "
            << count_text(scene.elements.size() + scene.linear.size(), "element") << ", "
            << count_text(scene.signals.size(), "signal") << '\n';
  if (!geometry.empty())
    std::cout << "frame: " << geometry << '\n';
  for (const BodyRequest &body : scene.bodies)
    if (body.part)
      std::cout << body.part->found << '\n';
  for (const std::string &warning : warnings)
    std::cerr << "gestell: warning: " << warning << '\n';
  return exit_done;
}

} // namespace gestell::apps
