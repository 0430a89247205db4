#include "apps/cli/command.h"
#include "apps/output/text/write_file.h"
#include "apps/templates/scene_templates.h"
#include "coupling/frame/atomic_file.h"
#include "fem/values/named_file.h"
#include "fem/values/shell_word.h"

#include <filesystem>
#include <iostream>
#include <memory>
#include <stdexcept>

namespace gestell::apps
{
namespace
{

struct NewOptions
{
  std::string kind, file; ///< empty: the list of kinds; KIND.toml
};

std::vector<std::string> kinds()
{
  std::vector<std::string> names;
  for (const SceneTemplate &any : scene_templates())
    names.push_back(any.kind);
  return names;
}

void list_kinds()
{
  for (const SceneTemplate &any : scene_templates())
    std::cout << any.kind << std::string(20 - any.kind.size(), ' ') << headline(any) << '\n';
}

/// Name of the scene in a file.
std::string name_of(const std::filesystem::path &file)
{
  if (file.extension() != ".toml" || file.stem().empty())
    throw std::invalid_argument(file.string() + ": the file name of a scene must end in .toml, such as machine.toml");
  const std::string name = file.stem().string();
  if (name.find_first_of("\"\\") != std::string::npos)
    throw std::invalid_argument(file.string() + ": the name of a scene must not contain quotes or backslashes");
  return name;
}

void require_free(const std::filesystem::path &file)
{
  if (fem::names_something(file) || std::filesystem::is_symlink(std::filesystem::symlink_status(file)))
    throw std::invalid_argument(
        file.string() + " already exists and is left unchanged; give another name: " + "gestell new KIND other.toml");
}

int make_new(const NewOptions &options)
{
  if (options.kind.empty())
  {
    list_kinds();
    return exit_done;
  }
  const SceneTemplate         chosen = scene_template(options.kind);
  const std::filesystem::path scene  = options.file.empty() ? options.kind + ".toml" : options.file;
  const std::filesystem::path frame  = std::filesystem::path(scene).replace_extension(".geo");
  const SceneTemplate         own    = named(chosen, name_of(scene));
  require_free(scene);
  require_free(frame);
  try
  {
    write_file(frame, own.frame);
    write_file(scene, own.scene);
  }
  catch (const coupling::WriteFailure &failure)
  {
    std::error_code none;
    std::filesystem::remove(frame, none); // the path was free: the file is ours
    throw std::invalid_argument(std::string(failure.what()) +
                                "; choose a folder with free space and write permission: gestell new " + chosen.kind +
                                " FOLDER/" + scene.filename().string());
  }
  std::cout << "written: " << scene.string() << ", and its frame " << frame.string() << "\nnext:    gestell check "
            << fem::typed_word(scene.string()) << "\n         gestell run " << fem::typed_word(scene.string()) << '\n';
  return exit_done;
}

} // namespace

Command new_command()
{
  const auto own = std::make_shared<NewOptions>();
  return {"new",
          "write a commented scene to start from, with its frame",
          {"gestell new press", "gestell new cam my_cam.toml"},
          CommandInput::none,
          {CommandOption{"KIND", &own->kind, "kind of machine (default: print the list of kinds)"}.proposing(kinds()),
           {"FILE", &own->file, "scene to write (default KIND.toml)"}},
          [own](const CommonOptions &) { return make_new(*own); }};
}

} // namespace gestell::apps
