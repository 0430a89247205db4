#include "apps/analysis/result_folder.h"
#include "apps/cli/cache_commands.h"
#include "apps/cli/command.h"
#include "apps/cli/command_answers.h"
#include "apps/cli/export_frame.h"
#include "apps/cli/json_answer.h"
#include "apps/cli/progress.h"
#include "apps/cli/results_path.h"
#include "apps/output/folder/own_folder.h"
#include "apps/output/report/frame_text.h"
#include "apps/scene/build/far_places.h"
#include "apps/session/session.h"
#include "apps/version.h"
#include "coupling/frame/frame_cache.h"
#include "coupling/modes/modes.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iomanip>
#include <iostream>
#include <memory>
#include <optional>

namespace gestell::apps
{

namespace
{

const char *const frame_name = "reduced_frame.h5";

Session scene_to_reduce(const CommonOptions &options, const Watch &watch = {})
{
  if (options.input.empty())
    throw std::invalid_argument("gestell reduce: the scene is missing; name one, or use --list or --prune");
  Session session(options.input, options.overrides, options.scripts, watch);
  session.check();
  if (frame_path(session.scene()) != FramePath::reduce)
    throw std::invalid_argument(session.scene().file +
                                ": the frame of this scene is not reduced; set reduction.method = \"craig-bampton\" "
                                "(frame from CAD, a mesh or large matrices)");
  return session;
}

/// Options that contradict each other.
void check_options(const CommonOptions &options, const ReduceCommandOptions &reduce)
{
  if (!reduce.prune && (reduce.all || !reduce.older_than.empty() || !reduce.larger_than.empty()))
    throw std::invalid_argument("gestell reduce: --all, --older-than and --larger-than need --prune; add it");
  if (reduce.check && !reduce.list && !reduce.prune)
    throw std::invalid_argument("gestell reduce: --check needs --list or --prune; add one of them");
  if ((reduce.prune || reduce.list) && !reduce.explain && !options.input.empty())
    throw std::invalid_argument("gestell reduce: --list and --prune apply to the whole cache; remove " + options.input);
}

void print_frame(const FrameAnswer &answer)
{
  const coupling::ReducedFrame &frame = answer.frame;
  std::cout
      << (answer.from_cache ? "reduced frame from the cache\n" : "reduced frame created\n") << "  DOFs          "
      << frame.n_full << " -> " << frame.n_interface << " interface + " << frame.omega0.size() << " modes\n"
      << "  static load on internal DOFs not represented by the modes: " << 100. * frame.static_residual
      << " % (by deflection energy; exact at the interface; it matters under quick accelerations of the frame; "
         "reduction.inertia_relief removes it)\n"
      << "  supported frame, interface free:\n    mode   frequency [Hz]     refined [Hz]   estimated relative error\n";
  const double limit = frame.frequency_limit_hz > 0. ? frame.frequency_limit_hz : INFINITY;
  for (Eigen::Index j = 0; j < frame.frequencies_hz.size(); ++j)
  {
    if (const std::string above = words_above(limit, j > 0 ? frame.frequencies_hz[j - 1] : 0., frame.frequencies_hz[j]);
        !above.empty())
      std::cout << "    " << above << '\n';
    std::cout << "    " << std::setw(4) << j + 1 << std::setprecision(8) << std::setw(17) << frame.frequencies_hz[j];
    if (j < frame.frequency_error.size() && std::isnan(frame.frequency_error[j]))
      std::cout << std::setw(17) << "unknown" << std::setw(27) << "unknown";
    else if (j < frame.frequency_error.size())
      std::cout << std::setw(17) << coupling::refined_hz(frame, j) << std::setprecision(3) << std::setw(27)
                << frame.frequency_error[j];
    std::cout << '\n';
  }
  std::cout << "  " << refined_words << '\n';
  for (const std::string &line : frame_text(answer.facts))
    std::cout << "  " << line << '\n';
  for (const std::string &note : frame.all_notes())
    std::cout << "  note: " << note << '\n';
}

void print_partition(const Partition &partition)
{
  std::cout << "q1: " << partition.rows.size() << " interface DOFs; q2: " << partition.n2 << " internal DOFs, in "
            << partition.n_modes << " modes\n";
  std::size_t width = 0;
  for (const Partition::Row &row : partition.rows)
    width = std::max(width, row.coordinate.size());
  for (const Partition::Row &row : partition.rows)
  {
    std::string reasons;
    for (const std::string &reason : row.reasons)
      reasons += (reasons.empty() ? "" : "; ") + reason;
    std::cout << "  " << std::left << std::setw(int(width)) << row.coordinate << std::right << "  "
              << (reasons.empty() ? "no object of the scene acts on it" : reasons) << '\n';
  }
  if (partition.n_free > 0)
    std::cout << "the frame has " << partition.n_free
              << " rigid-body modes; with fixed interfaces it has none, so C22 is positive definite; interface DOFs "
                 "retained for other reasons already constrain "
              << partition.n_held_by_acted << " of them\n";
  if (partition.n_massless > 0)
    std::cout << partition.n_massless
              << " internal DOFs have no mass: M22 is singular, they follow statically and have no modes\n";
  for (const Partition::Idle &idle : partition.superfluous)
    std::cout << "superfluous: interface "
              << idle.interface << ", on which no object acts and which no signal reads; without it the model has "
              << idle.coordinates << " DOFs less\n";
  for (const std::string &name : partition.only_read)
    std::cout << "only read: interface " << name
              << ", on which no object acts; it serves only signals, for which an output of the frame suffices\n";
}

int reduce_frame(const CommonOptions &options, const ReduceCommandOptions &reduce)
{
  check_options(options, reduce);
  if (reduce.prune)
    prune_cache(reduce);
  if (reduce.list)
    list_cache(reduce);
  if (reduce.explain)
    explain_cache(scene_to_reduce(options).scene());
  if (reduce.prune || reduce.list || reduce.explain)
    return exit_done;
  if (reduce.partition)
  {
    ProgressLine progress(options.quiet);
    const auto   partition = scene_to_reduce(options, {progress.callback()}).partition();
    progress.done();
    if (answers_in_json())
      answer_with(partition_answer(partition));
    print_partition(partition);
    return exit_done;
  }

  ProgressLine progress(options.quiet);
  Session      session = scene_to_reduce(options, {progress.callback()});
  const Scene &scene   = session.scene();
  const bool   exports = !reduce.export_format.empty();
  if (exports && scene.frame.source == FrameSource::parts)
    throw std::invalid_argument(scene.frame.place +
                                ": --export cannot write a frame of parts, because the forces in its joints need "
                                "accelerations; -o alone writes it for [frame] reduced = ...");
  const auto                 format = exports ? matrix_format(reduce.export_format) : MatrixFormat::matrix_market;
  const std::string          folder = exports ? results_path(options, scene).string() : options.folder;
  std::optional<ResultsLock> held;
  if (!folder.empty())
    held.emplace(folder);
  {
    std::vector<std::string> names = exports ? exported_names(format) : std::vector<std::string>();
    names.push_back(frame_name);
    OwnFolder(folder).require_free(names, inputs_of(options));
  }
  const FrameAnswer             answer = session.reduced_frame();
  const coupling::ReducedFrame &frame  = answer.frame;
  progress.done();

  if (!folder.empty())
  {
    const std::filesystem::path file = OwnFolder(folder).claim(frame_name);
    coupling::write_reduced_frame(file.string(), frame);
    std::cout << "written: " << file.string() << " (for [frame] reduced = ...)\n";
  }
  if (exports)
    for (const std::string &file : export_frame(
             folder, frame, format, "Reduced frame of " + scene.file + ", by gestell " + version + "; kg, m, N"))
      std::cout << "written: " << file << '\n';
  if (answers_in_json())
    answer_with(frame_answer(answer));
  print_frame(answer);
  for (const std::string &warning : places_far_from_faces(scene, frame))
    std::cerr << "gestell: warning: " << warning << '\n';
  for (const auto &[phase, seconds] : session.wall_seconds())
    std::cout << "  " << std::setprecision(3) << std::setw(8) << seconds << " s  " << phase << '\n';
  return exit_done;
}

} // namespace

/// The scene may be left out with --list and --prune.
Command reduce_command()
{
  const auto own = std::make_shared<ReduceCommandOptions>();
  return {
      "reduce",
      "build (or reuse) the reduced frame and report its error estimate",
      {"gestell reduce apps/scenes/press.toml --set reduction.modes=40",
       "gestell reduce --explain apps/scenes/press.toml", "gestell reduce --prune --older-than '30 d' --list"},
      CommandInput::scene_or_none,
      {{"--export", &own->export_format, "also write the reduced matrices: matrix-market, petsc or dmig (Nastran)"},
       {"--partition", &own->partition, "only print why each interface DOF is retained, and superfluous interfaces"},
       {"--list", &own->list, "only list the frames in the cache"},
       {"--explain", &own->explain, "only explain why the frame of the scene is in the cache or not"},
       {"--prune", &own->prune, "remove unusable files from the cache, and those selected by the following options"},
       {"--older-than", &own->older_than, "with --prune: frames not used for this time, such as \"30 d\""},
       {"--larger-than", &own->larger_than, "with --prune: frames larger than this, such as \"100 MB\""},
       {"--all", &own->all, "with --prune: all frames"},
       {"--check", &own->check, "with --list or --prune: compare every file with its checksum"}},
      [own](const CommonOptions &options) { return reduce_frame(options, *own); }};
}

} // namespace gestell::apps
