#include "apps/cli/command.h"
#include "apps/cli/progress.h"
#include "apps/cli/results_path.h"
#include "apps/output/folder/own_folder.h"
#include "apps/output/result_folder.h"
#include "apps/show/result_collections.h"
#include "apps/show/x_server.h"
#include "coupling/plugin/plugin.h"

#include <iostream>
#include <memory>
#include <stdexcept>

namespace gestell::apps
{

namespace
{

constexpr const char *show_library = "libgestell_show.so";

struct ShowOptions
{
  std::string folder, pictures;
  double      times = 0.;
  int         modes = 6, width = 1000;
  bool        films = true, quiet = false;
};

/// Loaded here, as VTK's rendering would make every start of the program slower.
DrawPictures *picture_service()
{
  const auto file = coupling::find_plugin(show_library);
  if (file.empty())
    throw std::invalid_argument(std::string("show: ") + show_library +
                                " not found beside the program: this build of gestell has no VTK to draw with; install "
                                "libvtk9-dev and build again, or open motion.pvd in ParaView");
  return reinterpret_cast<DrawPictures *>(
      coupling::function_of_plugin(coupling::load_plugin(file), "gestell_draw_pictures", show_library));
}

std::vector<std::string> names_of(const std::vector<PictureSeries> &all)
{
  std::vector<std::string> names;
  for (const PictureSeries &series : all)
    for (const char *const ending : {".png", ".ogv", ".apng", "/"})
      names.push_back(series.name + ending);
  return names;
}

int show(const ShowOptions &options)
{
  if (options.width < 200 || options.width > 4000)
    throw std::invalid_argument("--width: from 200 to 4000 pixels, got " + std::to_string(options.width));
  if (options.folder.empty())
    throw std::invalid_argument("show: needs the folder of a result, such as `gestell show results/press`");
  PictureRequest request;
  request.series = pictures_of(options.folder, static_cast<std::size_t>(options.modes));
  request.folder = options.pictures.empty() ? std::filesystem::path(options.folder) / "pictures"
                                            : std::filesystem::path(options.pictures);
  const ResultsLock held(request.folder);
  OwnFolder(request.folder).require_free(names_of(request.series));
  request.width       = options.width;
  request.height      = options.width * 4 / 5;
  request.enlargement = options.times;
  request.films       = options.films;
  ProgressLine progress(options.quiet);
  request.progress = [&](const std::string &phase, double share) { progress.show(phase, share); };

  const auto                     draw = picture_service();
  const XServer                  screen;
  const std::vector<std::string> files = draw(request);
  progress.done();
  for (const std::string &file : files)
    std::cout << file << '\n';
  return exit_done;
}

} // namespace

Command show_command()
{
  const auto own = std::make_shared<ShowOptions>();
  return {
      "show",
      "draw a result: the machine at its start and its peak, its motion, stresses and modes, as PNG pictures and films "
      "(APNG, OGV)",
      {"gestell show results/press", "gestell show results/press --no-films --times 500"},
      CommandInput::none,
      {{"DIR", &own->folder, "folder that `gestell run` or `gestell modes` wrote"},
       {"-o,--output", &own->pictures, "folder for the pictures (default DIR/pictures)"},
       CommandOption{"--times", &own->times, "enlargement of displacements (default: a round number)"}.above_zero(),
       CommandOption{"--modes", &own->modes, "modes of each kind (default 6)"}.above_zero(),
       CommandOption{"--width", &own->width, "of a picture in pixels (default 1000)"}.above_zero(),
       {"--films,!--no-films", &own->films, "films of the motion and of the modes, beside pictures"},
       {"--quiet", &own->quiet, "no progress on standard error"}},
      [own](const CommonOptions &) { return show(*own); }};
}

} // namespace gestell::apps
