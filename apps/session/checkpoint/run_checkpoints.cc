#include "apps/session/checkpoint/run_checkpoints.h"

#include "apps/session/checkpoint/checkpoint_file.h"
#include "coupling/frame/atomic_file.h"

namespace gestell::apps
{

/// The key is made when it is needed first: short runs keep nothing.
coupling::RunCheckpoints run_checkpoints(const CheckpointRequest &request, const SceneNode &scene,
                                         const coupling::Machine &machine, const coupling::InitialState &start,
                                         std::vector<std::string> &warnings)
{
  const auto               key = [scene, &machine, start] { return run_key(scene, machine, start); };
  coupling::RunCheckpoints checkpoints;
  checkpoints.every = request.every;
  if (request.resume)
    checkpoints.from = read_checkpoint(request.file, key());
  checkpoints.keep = [request, key, &warnings, made = std::vector<KeyPart>()](const std::string &state) mutable
  {
    if (made.empty())
      made = key();
    try
    {
      if (request.claim)
        request.claim();
      write_checkpoint(request.file, made, state);
    }
    catch (const coupling::WriteFailure &failure)
    {
      if (warnings.empty())
        warnings.push_back("the run cannot continue from its last state: " + std::string(failure.what()));
    }
  };
  return checkpoints;
}

} // namespace gestell::apps
