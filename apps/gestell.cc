// The program gestell: one executable with subcommands.

#include "apps/cli/commands.h"
#include "apps/cli/commit.h"
#include "apps/cli/team.h"
#include "apps/version.h"
#include "coupling/integration/system/second_order_system.h"
#include "fem/values/nearest_name.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <new>

namespace
{

/// CLI11's own check prints the largest number there is, with all its digits.
CLI::Validator above_zero()
{
  return CLI::Validator(
      [](const std::string &text)
      {
        char        *end   = nullptr;
        const double value = std::strtod(text.c_str(), &end);
        return *end == '\0' && !text.empty() && value > 0. && std::isfinite(value)
                   ? std::string()
                   : "needs a plain number above zero, got " + text;
      },
      "NUMBER");
}

using namespace gestell::apps;
namespace coupling = gestell::coupling;

std::vector<std::string> command_names(const CLI::App &program)
{
  std::vector<std::string> names;
  for (const CLI::App *command : program.get_subcommands([](const CLI::App *) { return true; }))
    names.push_back(command->get_name());
  return names;
}

/// The first word is no option and no command.
void require_command(const CLI::App &program, const std::string &word)
{
  const auto names = command_names(program);
  if (!word.empty() && word.front() != '-' && std::find(names.begin(), names.end(), word) == names.end())
    throw std::invalid_argument("there is no command '" + word + "'" + gestell::suggestion(word, names));
}

/// What is left of the command line: an option of another command, a slip, a second scene.
std::invalid_argument unexpected(const CLI::App &program)
{
  const CLI::App          *command = program.get_subcommands().empty() ? &program : program.get_subcommands().front();
  const std::string        word    = program.remaining(true).front();
  std::vector<std::string> options;
  for (const CLI::Option *option : command->get_options())
    for (const std::string &name : option->get_lnames())
      options.push_back("--" + name);
  return std::invalid_argument(command->get_name() + ": " +
                               (word.front() == '-'
                                    ? "there is no option " + word + gestell::suggestion(word, options)
                                    : "'" + word + "' is one input too many; names with spaces stand in quotes"));
}

CLI::App *add_command(CLI::App &program, const std::string &name, const std::string &does, const std::string &example,
                      const std::string &input, CommonOptions &options)
{
  CLI::App *command = program.add_subcommand(name, does);
  command->footer("Example:\n  " + example);
  command->add_option(input, options.input, input == "SCENE" ? "scene file (TOML)" : "STEP, BREP, .geo or .msh file")
      ->required();
  command->add_option("--jobs", options.jobs, "threads of the linear algebra that makes a frame (default 1)")
      ->check(above_zero());
  command->add_flag("--quiet", options.quiet, "no progress on standard error");
  command->add_flag_callback(
      "--trust-scripts", [&options] { options.scripts = gestell::fem::Scripts::trusted; },
      "run scripts of gmsh (.geo) as they are, which may run programs and write files");
  if (input == "SCENE")
  {
    command->add_option("-o,--output", options.folder, "folder for results (default results/<scene name>)");
    command->add_option("--set", options.overrides, "override an entry of the scene: key.path=value")
        ->allow_extra_args(false);
  }
  return command;
}

CLI::App *add_chart(CLI::App &program, CommonOptions &options, ChartCommandOptions &chart)
{
  CLI::App *command =
      add_command(program, "chart", "work-precision chart: error against work of methods and settings",
                  "gestell chart apps/scenes/press_minimal.toml --quick -o results/chart", "SCENE", options);
  command->add_option("--methods", chart.methods, "methods by name, such as bdf-2,exact*,cvode-5 (default: all)")
      ->delimiter(',');
  command->add_option("--steps", chart.steps, "fixed steps, such as \"40 us\",\"10 us\"")->delimiter(',');
  command->add_option("--tolerances", chart.tolerances, "tolerances of controlled steps, such as 1e-3,1e-5")
      ->delimiter(',');
  command->add_option("--error", chart.errors, "errors a choice is offered for (default 1e-2,1e-3,1e-5,1e-7)")
      ->delimiter(',');
  command->add_option("--signals", chart.signals, "signals that errors are measured in (default: all of the scene)")
      ->delimiter(',');
  command->add_option("--modes", chart.modes, "numbers of modes of the reduced frame, such as 10,20,50")
      ->delimiter(',')
      ->check(above_zero());
  command->add_option("--reference", chart.reference, "table of the true motion (CSV) instead of an own fine run")
      ->check(CLI::ExistingFile);
  command->add_option("--events", chart.events, "on: located, off: passed over, both (default)")
      ->check(CLI::IsMember({"on", "off", "both"}));
  command->add_flag("--peers,!--no-peers", chart.peers, "general-purpose integrators as well (default)");
  command->add_flag("--native-vectors", chart.native, "peers with vector arithmetic compiled for this processor");
  command->add_flag("--quick", chart.quick, "a minute instead of ten: fewer methods, steps and tolerances");
  command->add_option("--samples", chart.samples, "instants that errors are measured at (default 2000)");
  command->add_option("--limit", chart.limit, "CPU time of one run [s]; longer ones are given up (default 20, quick 5)")
      ->check(above_zero());
  return command;
}

CLI::App *add_modes(CLI::App &program, CommonOptions &options, ModesCommandOptions &modes)
{
  CLI::App *command = add_command(
      program, "modes", "natural frequencies and shapes of the frame and of the coupled machine",
      "gestell modes apps/scenes/press_minimal.toml\n  gestell modes apps/scenes/press_minimal.toml --along crank",
      "SCENE", options);
  CLI::Option *along = command->add_option("--along", modes.along,
                                           "follow them along a coordinate: a body, a measure or a driven joint");
  const auto   add   = [&](const std::string &name, auto &value, const std::string &text)
  { return command->add_option(name, value, text)->needs(along); };
  add("--from", modes.from, "first position, such as \"100 deg\" or \"2.4 m\" (default 0 for angles)");
  add("--to", modes.to, "last position (default one turn further)");
  add("--positions", modes.positions, "how many, both ends included (default 73: every 5 deg of a turn)");
  add("--configuration", modes.configuration,
      "equilibrium (default): standing still under weights and springs; or undeformed")
      ->check(CLI::IsMember({"equilibrium", "undeformed"}));
  add("--hold", modes.hold, "coordinates that do not vibrate, such as a held drive")->delimiter(',');
  add("--speed", modes.speed, "speed whose orders excite, such as \"30 1/min\" (default: at the start)");
  add("--orders", modes.orders, "highest order (default 10)")->check(above_zero());
  add("--band", modes.band, "how near an order comes to be told (default \"5 %\")");
  CLI::Option *converge =
      command->add_option("--converge", modes.converge,
                          "refine the frame's mesh until frequencies and compliances are within this "
                          "share, such as 0.01; tell error and uncertainty");
  converge->check(above_zero());
  command->add_option("--frequencies", modes.frequencies, "lowest elastic ones of the frame to converge (default 4)")
      ->needs(converge)
      ->check(above_zero());
  command
      ->add_option("--watch", modes.watch, "what is to converge: all, or frequencies without compliances (default all)")
      ->needs(converge)
      ->check(CLI::IsMember({"all", "frequencies"}));
  command->add_option("--max-coordinates", modes.max_coordinates, "of the finest mesh (default 1000000)")
      ->needs(converge)
      ->check(above_zero());
  command->add_option("--geometric", modes.geometric, "on (default) or off: geometric stiffness of forces that turn")
      ->check(CLI::IsMember({"on", "off"}));
  return command;
}

/// The scene may be left out with --list and --prune.
CLI::App *add_reduce(CLI::App &program, CommonOptions &options, ReduceCommandOptions &reduce)
{
  CLI::App *command = add_command(program, "reduce", "build (or reuse) the reduced frame and report its error estimate",
                                  "gestell reduce apps/scenes/press.toml --set reduction.modes=40\n"
                                  "  gestell reduce --explain apps/scenes/press.toml\n"
                                  "  gestell reduce --prune --older-than '30 d' --list",
                                  "SCENE", options);
  command->get_option("SCENE")->required(false);
  command->add_option("--export", reduce.export_format, "write the reduced matrices, too: matrix-market or petsc");
  command->add_flag("--list", reduce.list, "the frames in the cache instead");
  command->add_flag("--explain", reduce.explain, "why the scene's frame is in the cache or not, instead");
  command->add_flag("--prune", reduce.prune, "remove what cannot be used from the cache, and what these name:");
  command->add_option("--older-than", reduce.older_than, "frames not used for so long, such as \"30 d\"");
  command->add_option("--larger-than", reduce.larger_than, "frames of more than, such as \"100 MB\"");
  command->add_flag("--all", reduce.all, "all frames");
  command->add_flag("--check", reduce.check, "with --list or --prune: compare every file with its checksum");
  return command;
}

/// The scene may be left out.
CLI::App *add_stability(CLI::App &program, CommonOptions &options, StabilityCommandOptions &stability)
{
  CLI::App *command =
      add_command(program, "stability", "stability and accuracy maps of the integrators, over a scene's own modes",
                  "gestell stability apps/scenes/press_minimal.toml --zeta 0,0.02", "SCENE", options);
  command->get_option("SCENE")->required(false);
  command->add_option("--zeta", stability.zetas, "damping ratios of the maps (default 0,0.01,0.05)")->delimiter(',');
  command->add_option("--step", stability.step, "step [s] at which the scene's modes are shown (default run.step)")
      ->check(above_zero());
  command->add_option("--atlas", stability.atlas, "write the failure atlas into this file (Markdown) instead");
  return command;
}

CLI::App *add_help(CLI::App &program, HelpCommandOptions &help)
{
  CLI::App *command = program.add_subcommand("help", "explain the keys of a scene");
  command->footer("Example:\n  gestell help element.clearance\n  gestell help stiffness");
  command->add_option("KEY", help.topic, "table or key (default: the list of tables)");
  command->add_flag("--schema", help.schema, "JSON schema of scenes, for editors, instead");
  command->add_option("--renew", help.docs,
                      "write schema and tables of keys in this folder of documents anew, instead");
  return command;
}

int run_program(int argc, char **argv)
{
  CLI::App program{"Gestell computes how a machine and the frame that carries it shake each other.", "gestell"};
  program.set_version_flag("--version",
                           std::string("gestell ") + version + (commit().empty() ? "" : " (" + commit() + ")"));
  program.require_subcommand(1);

  CommonOptions        options;
  MeshCommandOptions   mesh;
  ModesCommandOptions  modes_options;
  ReduceCommandOptions reduce_options;
  ChartCommandOptions  chart_options;
  CLI::App            *run    = add_command(program, "run", "simulate a scene in time",
                                            "gestell run apps/scenes/press.toml -o results/press", "SCENE", options);
  CLI::App            *modes  = add_modes(program, options, modes_options);
  CLI::App            *reduce = add_reduce(program, options, reduce_options);
  CLI::App            *check  = add_command(program, "check", "validate a scene without computing",
                                            "gestell check apps/scenes/press.toml", "SCENE", options);
  CLI::App            *chart  = add_chart(program, options, chart_options);
  CLI::App            *mesher = add_command(program, "mesh", "mesh a CAD file; report its quality, surfaces and solids",
                                            "gestell mesh meshes/press_frame.step --size '80 mm'", "CAD", options);
  mesher->add_option("--size", mesh.size, "element size, such as \"80 mm\"");
  mesher->add_option("--unit", mesh.unit, "length unit of a file without one, such as \"1 mm\"");
  mesher->add_option("--max-cells", mesh.max_cells, "refuse a mesh of more elements")->check(above_zero());
  mesher->add_option("--gap", mesh.gap, "join solids at most that far apart, such as \"0.1 mm\"");
  mesher->add_option("--bodies", mesh.bodies, "number of bodies expected that do not hang together")
      ->check(CLI::PositiveNumber);
  mesher->add_option("--overlaps", mesh.overlaps, "refused, or once: a common part of solids belongs to the first")
      ->check(CLI::IsMember({"refused", "once"}));
  mesher->add_option("--density", mesh.density, "what solids are weighed with, such as \"2700 kg/m^3\" (steel)");
  mesher->add_option("--defeature", mesh.defeature, "remove faces and edges smaller than this, such as \"2 mm\"");
  mesher->add_flag("--selectors", mesh.selectors, "write surfaces as entries [frame.surface.NAME] of a scene");

  StabilityCommandOptions stability_options;
  CLI::App               *stability = add_stability(program, options, stability_options);

  HelpCommandOptions help_options;
  const CLI::App    *help = add_help(program, help_options);

  if (argc > 1)
    require_command(program, argv[1]);
  try
  {
    program.parse(argc, argv);
  }
  catch (const CLI::ExtrasError &)
  {
    throw unexpected(program);
  }
  catch (const CLI::ParseError &error)
  {
    return program.exit(error) == 0 ? exit_done : exit_wrong_input;
  }

  if (options.jobs > 1)
    setenv("OPENBLAS_NUM_THREADS", std::to_string(options.jobs).c_str(), 1);
  if (run->parsed())
    return run_command(options);
  if (modes->parsed())
    return modes_command(options, modes_options);
  if (reduce->parsed())
    return reduce_command(options, reduce_options);
  if (chart->parsed())
    return chart_command(options, chart_options);
  if (check->parsed())
    return check_command(options);
  if (stability->parsed())
    return stability_command(options, stability_options);
  if (help->parsed())
    return help_command(help_options);
  return mesh_command(options, mesh);
}

} // namespace

int main(int argc, char **argv)
{
  const bool speaks = coupling::launch().rank == 0; // of all that mpirun started
  try
  {
    MpiRun ranks;
    if (!ranks.serves())
      return run_program(argc, argv);
    ranks.serve();
    return exit_done;
  }
  catch (const std::invalid_argument &error)
  {
    if (speaks)
      std::cerr << "gestell: " << error.what() << '\n';
    return exit_wrong_input;
  }
  catch (const std::bad_alloc &)
  {
    if (speaks)
      std::cerr << "gestell: the computation failed: out of memory; take a coarser mesh (mesh.size), fewer modes "
                   "(reduction.modes) or a larger step of what is kept (output.step, output.picture_step, "
                   "output.stress.step), or a machine with more memory\n";
    return exit_failed;
  }
  catch (const std::exception &error)
  {
    if (speaks)
      std::cerr << "gestell: the computation failed: " << error.what() << '\n';
    return exit_failed;
  }
}
