#pragma once

/// Of the plugin behind TeamService; collective.  How many ranks were called otherwise than rank 0: by other words, or
/// in another folder where that of rank 0 is there, too (launchers go elsewhere where it is not).
extern "C" __attribute__((visibility("default"))) int gestell_ranks_called_otherwise(const char *words,
                                                                                     const char *folder);
