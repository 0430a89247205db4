#include "fem/values/cell_shape.h"

namespace gestell::fem
{

namespace
{

const CellShape tetrahedron = {4,
                               {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}},
                               {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}},
                               {{1, 2, 3}, {2, 0, 3}, {0, 1, 3}, {0, 2, 1}},
                               {{0, 1, 2, 3}}};

// Pieces along the diagonal from corner 0 to corner 6.
const CellShape hexahedron = {
    8,
    {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6}, {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}},
    {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}},
    {{1, 3, 4}, {2, 0, 5}, {3, 1, 6}, {0, 2, 7}, {7, 5, 0}, {4, 6, 1}, {5, 7, 2}, {6, 4, 3}},
    {{0, 1, 2, 6}, {0, 2, 3, 6}, {0, 3, 7, 6}, {0, 7, 4, 6}, {0, 4, 5, 6}, {0, 5, 1, 6}}};

const CellShape prism = {6,
                         {{0, 1}, {1, 2}, {2, 0}, {3, 4}, {4, 5}, {5, 3}, {0, 3}, {1, 4}, {2, 5}},
                         {{0, 2, 1}, {3, 4, 5}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}},
                         {{1, 2, 3}, {2, 0, 4}, {0, 1, 5}, {5, 4, 0}, {3, 5, 1}, {4, 3, 2}},
                         {{0, 1, 2, 5}, {0, 1, 5, 4}, {0, 4, 5, 3}}};

} // namespace

const CellShape &cell_shape(CellKind kind)
{
  return kind == CellKind::tetrahedron ? tetrahedron : kind == CellKind::hexahedron ? hexahedron : prism;
}

} // namespace gestell::fem
