#include "coupling/dense/dense_instances.h"

GESTELL_DENSE_INSTANCES()
