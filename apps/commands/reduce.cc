#include "apps/commands/commands.h"
#include "apps/commands/prepared_machine.h"
#include "apps/output/frame_lines.h"
#include "apps/output/result_folder.h"
#include "apps/scene/damping_text.h"
#include "coupling/reduced_frame_file.h"

#include <iomanip>
#include <iostream>

namespace gestell::apps
{

int reduce_command(const CommonOptions &options)
{
  const Scene scene = read_scene(options.input, options.overrides);
  check_scene(scene);
  if (frame_path(scene) != FramePath::reduce)
    throw std::invalid_argument(scene.file + ": this scene's frame is not reduced; give it reduction.method = "
                                             "\"craig-bampton\" and a frame from CAD, a mesh or large matrices");
  if (!options.folder.empty())
    require_writable(options.folder);
  ProgressLine                 progress(options.quiet);
  bool                         from_cache = false;
  const coupling::ReducedFrame frame      = reduced_frame(scene, progress, from_cache);
  progress.done();

  if (!options.folder.empty())
  {
    const std::filesystem::path file = std::filesystem::path(options.folder) / "reduced_frame.h5";
    std::filesystem::create_directories(options.folder);
    coupling::write_reduced_frame(file.string(), frame);
    std::cout << "written: " << file.string() << " (for [frame] reduced = ...)\n";
  }
  std::cout << (from_cache ? "reduced frame from the cache\n" : "reduced frame made\n") << "  coordinates   "
            << frame.n_full << " -> " << frame.n_interface << " interface + " << frame.omega0.size() << " modes\n"
            << "  static load on the inside not carried by the modes: " << 100. * frame.static_residual
            << " % (energy; exact at the interface)\n"
            << "  supported frame, interface free:\n    mode   frequency [Hz]   estimated relative error\n";
  for (Eigen::Index j = 0; j < frame.frequencies_hz.size(); ++j)
  {
    std::cout << "    " << std::setw(4) << j + 1 << std::setprecision(8) << std::setw(17) << frame.frequencies_hz[j];
    if (j < frame.frequency_error.size())
      std::cout << std::setprecision(3) << std::setw(27) << frame.frequency_error[j];
    std::cout << '\n';
  }
  ModelFacts facts;
  facts.frame        = frame.facts;
  facts.frame_mass   = frame.mass;
  facts.free_motions = static_cast<int>((frame.frequencies_hz.array() == 0.).count());
  facts.damping      = damping_text(scene.frame);
  for (const std::string &line : frame_lines(facts))
    std::cout << "  " << line << '\n';
  for (const std::string &note : frame.notes)
    std::cout << "  note: " << note << '\n';
  for (const auto &[phase, seconds] : progress.wall_seconds())
    std::cout << "  " << std::setprecision(3) << std::setw(8) << seconds << " s  " << phase << '\n';
  return exit_done;
}

} // namespace gestell::apps
