#pragma once

/// Function of the plugin with TeamService; collective.  Number of ranks started differently from rank 0: with another
/// command line, or in another folder although that of rank 0 exists (otherwise launchers change the folder).
extern "C" __attribute__((visibility("default"))) int gestell_ranks_called_otherwise(const char *words,
                                                                                     const char *folder);
