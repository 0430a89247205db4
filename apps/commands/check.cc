#include "apps/commands/commands.h"
#include "apps/scene/build_machine.h"

#include <iostream>

namespace gestell::apps
{

int check_command(const CommonOptions &options)
{
  const Scene scene = read_scene(options.input, options.overrides);
  check_scene(scene);
  std::cout << scene.file << ": the scene \"" << scene.name << "\" is well formed: " << scene.bodies.size()
            << " bodies, " << scene.elements.size() + scene.linear.size() << " elements, " << scene.signals.size()
            << " signals\n";
  for (const BodyRequest &body : scene.bodies)
    if (body.part)
      std::cout << body.part->found << '\n';
  for (const std::string &warning : scene.warnings)
    std::cerr << "gestell: warning: " << warning << '\n';
  return exit_done;
}

} // namespace gestell::apps
