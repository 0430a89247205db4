#pragma once

#include "fem/values/cad_source.h"

#include <string>
#include <vector>

namespace gestell::apps
{

/// Exit codes of the program.
enum ExitCode
{
  exit_done        = 0,
  exit_wrong_input = 2,
  exit_failed      = 3,
  exit_interrupted = 130
};

/// What every subcommand takes.
struct CommonOptions
{
  std::string              input;  ///< scene, or CAD file of `gestell mesh`
  std::string              folder; ///< -o; empty: results/<scene name>
  std::vector<std::string> overrides;
  int                      jobs    = 1;
  bool                     quiet   = false;
  fem::Scripts             scripts = fem::Scripts::harmless; ///< of gmsh, that scenes name
};

struct MeshCommandOptions
{
  std::string size; ///< a length such as "80 mm", plain numbers in m; empty: chosen for some 25 000 cells
  std::string unit; ///< length of what the file calls 1, such as "1 mm"; empty: the file knows
  double      max_cells = 2e6;
  std::string gap;                   ///< a length: solids at most that far apart are joined
  std::string density;               ///< solids are weighed with; steel by default
  std::string defeature;             ///< a length: smaller faces and edges are removed
  std::string overlaps  = "refused"; ///< or "once"
  int         bodies    = 1;         ///< expected
  bool        selectors = false;     ///< surfaces as entries of a scene
};

/// What `gestell chart` compares; empty lists: chosen for the scene.
struct ChartCommandOptions
{
  std::vector<std::string> methods;          ///< keys such as "exact-6", "cvode-5", "bdf*"
  std::vector<std::string> steps;            ///< of fixed steps, "10 us" or plain numbers in s
  std::vector<std::string> tolerances;       ///< of controlled steps and of peers
  std::vector<std::string> errors;           ///< that a choice is offered for
  std::vector<std::string> signals;          ///< that errors are measured in; "q*" for all that begin so
  std::vector<int>         modes;            ///< numbers of modes of the reduced frame
  std::string              reference;        ///< CSV file; empty: an own fine run
  std::string              events  = "both"; ///< "both", "on" or "off"
  bool                     peers   = true;   ///< general-purpose libraries as well
  bool                     native  = false;  ///< vectors of peers compiled for this processor
  bool                     quick   = false;  ///< fewer methods and settings
  int                      samples = 2000;   ///< instants errors are measured at
  double                   limit   = 0.;     ///< [s] of CPU time for one run; 0: 20, quick 5
};

/// `gestell modes`: about one position, or along a coordinate.
struct ModesCommandOptions
{
  std::string              along;                ///< coordinate; empty: one position
  std::string              from, to;             ///< "100 deg", plain numbers in SI; empty: one turn of an angle
  int                      positions     = 73;   ///< both ends included
  std::string              geometric     = "on"; ///< "on" or "off"
  std::string              configuration = "equilibrium"; ///< or "undeformed"
  std::vector<std::string> hold;                          ///< coordinates at rest in the linearised machine
  std::string              speed;                         ///< of the excitation; empty: that of the scene's start
  int                      orders          = 10;          ///< multiples of it that are looked at
  std::string              band            = "5 %";       ///< how near an order comes to count
  double                   converge        = 0.;    ///< relative error the mesh may leave; 0: the scene's mesh as it is
  int                      frequencies     = 4;     ///< lowest elastic ones of the frame that `converge` watches
  std::string              watch           = "all"; ///< or "frequencies": compliances of interfaces are left out
  int                      max_coordinates = 1000000; ///< of the finest mesh
};

/// `gestell reduce`: a scene's frame, or the cache of frames.
struct ReduceCommandOptions
{
  bool        list = false, explain = false, prune = false;
  bool        all   = false;           ///< prune every frame
  bool        check = false;           ///< list and prune read every file whole
  std::string older_than, larger_than; ///< prune frames not used for "30 d", frames above "100 MB"
  std::string export_format;           ///< "matrix-market" or "petsc"; empty: none
};

struct StabilityCommandOptions
{
  std::vector<double> zetas = {0., 0.01, 0.05}; ///< damping ratios of the maps
  double              step  = 0.;               ///< [s] at which the scene's modes are shown; 0: run.step
  std::string         atlas;                    ///< file of the failure atlas; empty: none
};

struct HelpCommandOptions
{
  std::string topic; ///< table or key; empty: the list of tables
  bool        schema = false;
  std::string docs; ///< folder whose schema and tables of keys are renewed; empty: none
};

/// Each returns an ExitCode; wrong input throws std::invalid_argument, failed methods ConvergenceFailure.
int run_command(const CommonOptions &options);
int modes_command(const CommonOptions &options, const ModesCommandOptions &modes);
/// options.input may be empty with list and prune.
int reduce_command(const CommonOptions &options, const ReduceCommandOptions &reduce);
int mesh_command(const CommonOptions &options, const MeshCommandOptions &mesh);
int check_command(const CommonOptions &options);
/// options.input may be empty: maps alone.
int stability_command(const CommonOptions &options, const StabilityCommandOptions &stability);
int help_command(const HelpCommandOptions &help);
int chart_command(const CommonOptions &options, const ChartCommandOptions &chart);

} // namespace gestell::apps
