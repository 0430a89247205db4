#include "tests/fuzz/target.h"

#include "apps/session/checkpoint/checkpoint_file.h"
#include "apps/show/result_collections.h"
#include "apps/study/runs/rows_file.h"
#include "apps/study/runs/study_record.h"
#include "coupling/frame/frame_recipe.h"
#include "coupling/frame/reduced_frame_file.h"
#include "coupling/frame/sha256.h"
#include "fem/process/child.h"

#include <stdexcept>
#include <typeinfo>

namespace gestell::fuzz
{
namespace
{

using namespace gestell::apps;

void checkpoint(const std::string &bytes)
{
  const std::vector<KeyPart> key{{"the program", "1"}, {"the scene", "2"}};
  read_checkpoint(file_of("checkpoint", bytes), key);
}

/// Sealed anew, so that what is changed behind the head gets past the checksum as a forged one would.
std::string sealed(const std::string &bytes)
{
  constexpr std::size_t head = 512;
  const std::string     hash = "sha256 ";
  const std::size_t     at   = bytes.substr(0, head).find(hash);
  if (bytes.size() < head || at == std::string::npos || at + hash.size() + 64 > head)
    return bytes;
  return bytes.substr(0, at) + hash + coupling::Sha256().update(bytes.substr(head)).hexadecimal() +
         bytes.substr(at + hash.size() + 64);
}

/// Refusals are std::runtime_error itself, as the documentation of these readers says.
template <typename Read>
void refuses_by_runtime_error(const Read &read, const std::string &file)
{
  try
  {
    read(file);
  }
  catch (const std::runtime_error &refused)
  {
    if (typeid(refused) != typeid(std::runtime_error))
      throw;
  }
}

void frame(const std::string &bytes)
{
  const std::string file = file_of("frame.h5", sealed(bytes));
  refuses_by_runtime_error(coupling::read_frame_summary, file);
  if (fem::in_one_process()) // read_stored_frame() has no child of its own: it reads the cache of the user
    refuses_by_runtime_error(coupling::read_stored_frame, file);
  try
  {
    coupling::read_reduced_frame(file);
  }
  catch (const std::invalid_argument &refused)
  {
    if (std::string(refused.what()).find(file) == std::string::npos)
      throw;
  }
}

void recipe(const std::string &bytes)
{
  coupling::Recipe recipe;
  try
  {
    recipe = coupling::parse_recipe(bytes);
  }
  catch (const std::runtime_error &refused) // as its documentation says
  {
    if (typeid(refused) != typeid(std::runtime_error))
      throw;
    throw std::invalid_argument(refused.what());
  }
  const std::string text = coupling::text_of(recipe);
  promise(coupling::text_of(coupling::parse_recipe(text)) == text, "a recipe does not read back");
}

/// Of a study with two variables and an output.
void rows(const std::string &bytes)
{
  StudyFile study;
  for (const char *name : {"a", "b"})
  {
    study.variables.emplace_back();
    study.variables.back().variable.name = name;
  }
  study.outputs.push_back({"F", "signals.F.max", {}});
  read_rows(file_of("runs.csv", bytes), RowsText(study));
}

void record(const std::string &bytes)
{
  read_record(file_of("study.json", bytes));
}

void collection(const std::string &bytes)
{
  read_collection(file_of("motion.pvd", bytes));
}

} // namespace

std::vector<Target> kept_targets()
{
  return {{"checkpoint", checkpoint}, {"collection", collection}, {"frame", frame},
          {"recipe", recipe},         {"study_rows", rows},       {"study_record", record}};
}

} // namespace gestell::fuzz
