// gestell_fuzz_meshes TARGET FROM TO [FOLDER]: executes the mutations of these numbers, keeps files that died in gmsh,
// were ended by limits or found; gestell_fuzz_meshes TARGET NUMBER: one, as the program reads it.  Ends with 1 if there
// are findings.

#include "tests/fuzz/mesh/mesh_fuzz.h"

#include <exception>
#include <iostream>
#include <string>

namespace
{

using namespace gestell::fuzz;

int run(int argc, char **argv)
{
  if (argc < 3 || argc > 5)
  {
    std::cerr << "gestell_fuzz_meshes TARGET FROM TO [FOLDER], or TARGET NUMBER; targets:";
    for (const std::string &name : mesh_target_names())
      std::cerr << ' ' << name;
    std::cerr << '\n';
    return 2;
  }
  const MeshTarget &target = mesh_target(argv[1]);
  if (argc == 3)
  {
    const Judgement judgement = judge_alone(write_mutation(target, std::stoull(argv[2]), "."), std::stoull(argv[2]));
    std::cout << static_cast<char>(judgement.outcome) << ' ' << judgement.words << "\n./fed" << target.extension
              << '\n';
    return judgement.outcome == Outcome::finding;
  }
  FuzzOptions options;
  options.report_every = 10000;
  if (argc == 5)
    options.keep = argv[4];
  const Tally tally = fuzz(target, std::stoull(argv[2]), std::stoull(argv[3]), options);
  std::cout << target.name << ": " << tally.text() << '\n';
  return !tally.findings.empty();
}

} // namespace

int main(int argc, char **argv)
{
  try
  {
    return run(argc, argv);
  }
  catch (const std::exception &error)
  {
    std::cerr << "gestell_fuzz_meshes: " << error.what() << '\n';
    return 2;
  }
}
