#include "apps/session/checkpoint/run_checkpoints.h"

#include "apps/session/checkpoint/checkpoint_file.h"

namespace gestell::apps
{

/// The key is made when it is needed first: short runs keep nothing.
coupling::RunCheckpoints run_checkpoints(const CheckpointRequest &request, const SceneNode &scene,
                                         const coupling::Machine &machine, const coupling::InitialState &start)
{
  const auto               key = [scene, &machine, start] { return run_key(scene, machine, start); };
  coupling::RunCheckpoints checkpoints;
  checkpoints.every = request.every;
  if (request.resume)
    checkpoints.from = read_checkpoint(request.file, key());
  checkpoints.keep = [file = request.file, key, made = std::vector<KeyPart>()](const std::string &state) mutable
  {
    if (made.empty())
      made = key();
    write_checkpoint(file, made, state);
  };
  return checkpoints;
}

} // namespace gestell::apps
