#include "apps/analysis/result_folder.h"
#include "apps/cli/command.h"

#include "apps/cli/progress.h"
#include "apps/cli/results_path.h"
#include "apps/output/folder/own_folder.h"
#include "apps/show/result_collections.h"
#include "coupling/plugin/plugin.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/types.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <string>

namespace gestell::apps
{

namespace
{

/// An X server without a screen (Xvfb), for VTK to draw on; DISPLAY names it while it lives.
class XServer
{
public:
  XServer(); ///< @throws std::invalid_argument if Xvfb is missing or does not start
  ~XServer();
  XServer(const XServer &)            = delete;
  XServer &operator=(const XServer &) = delete;

private:
  pid_t process_ = -1;
};

/// The number of the display, which Xvfb writes once it serves; "" if it ends or keeps silent before.
std::string display_from(int pipe)
{
  std::string text;
  for (char c; text.find('\n') == std::string::npos;)
  {
    pollfd        wait{pipe, POLLIN, 0};
    constexpr int patience_ms = 20000; // the X server starts within some seconds, also on a slow machine
    if (poll(&wait, 1, patience_ms) <= 0 || read(pipe, &c, 1) <= 0)
      return "";
    text += c;
  }
  return text.substr(0, text.find('\n'));
}

[[noreturn]] void become_server(int pipe)
{
  prctl(PR_SET_PDEATHSIG, SIGTERM); // it never outlives the program
  setpgid(0, 0);                    // an interruption is for the program, which then ends it
  const int nowhere = open("/dev/null", O_RDWR);
  dup2(nowhere, STDIN_FILENO);
  dup2(nowhere, STDOUT_FILENO);
  dup2(nowhere, STDERR_FILENO);
  const std::string number = std::to_string(pipe);
  execlp("Xvfb", "Xvfb", "-displayfd", number.c_str(), "-screen", "0", "1280x1024x24", "-nolisten", "tcp", "-noreset",
         static_cast<char *>(nullptr));
  _exit(127);
}

XServer::XServer()
{
  int ends[2];
  if (pipe(ends) != 0)
    throw std::runtime_error("show: no pipe to Xvfb");
  process_ = fork();
  if (process_ == 0)
  {
    close(ends[0]);
    become_server(ends[1]);
  }
  close(ends[1]);
  const std::string display = process_ > 0 ? display_from(ends[0]) : "";
  close(ends[0]);
  if (display.empty())
  {
    if (process_ > 0)
    {
      kill(process_, SIGTERM);
      waitpid(process_, nullptr, 0);
    }
    throw std::invalid_argument("show: Xvfb (X server without a screen) is missing or does not start; install the "
                                "package xvfb, or open motion.pvd in ParaView");
  }
  setenv("DISPLAY", (":" + display).c_str(), 1);
}

XServer::~XServer()
{
  kill(process_, SIGTERM);
  waitpid(process_, nullptr, 0);
}

constexpr const char *show_library = "libgestell_show.so";

struct ShowOptions
{
  std::string folder, pictures;
  double      times = 0.;
  int         modes = 6, width = 1000;
  bool        films = true, quiet = false;
};

/// Loads VTK's rendering only here, because it would slow down every start of the program.
DrawPictures *picture_service()
{
  const auto file = coupling::find_plugin(show_library);
  if (file.empty())
    throw std::invalid_argument(std::string("show: ") + show_library +
                                " not found next to the program: this build of gestell has no VTK; install libvtk9-dev "
                                "and build again, or open motion.pvd in ParaView");
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
  return {"show",
          "draw results as PNG pictures and films (APNG, OGV): machine at the start and at the main peak, motion, "
          "stresses and modes",
          {"gestell show results/press", "gestell show results/press --no-films --times 500"},
          CommandInput::none,
          {{"DIR", &own->folder, "folder of results of `gestell run` or `gestell modes`"},
           {"-o,--output", &own->pictures, "folder for the pictures (default DIR/pictures)"},
           CommandOption{"--times", &own->times, "enlargement of displacements (default: a round number)"}.above_zero(),
           CommandOption{"--modes", &own->modes, "number of modes of each kind (default 6)"}.above_zero(),
           CommandOption{"--width", &own->width, "width of a picture in pixels (default 1000)"}.above_zero(),
           {"--films,!--no-films", &own->films, "films of the motion and of the modes, in addition to pictures"},
           {"--quiet", &own->quiet, "no progress on standard error"}},
          [own](const CommonOptions &) { return show(*own); }};
}

} // namespace gestell::apps
