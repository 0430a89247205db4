// Column of a press frame in four parts, drawn in mm: a hollow box through which a tie rod passes.  z up; symmetric about
// x = 0 and y = 0; it stands on z = 0.
SetFactory("OpenCASCADE");
Geometry.OCCAutoFix = 0;

width  = 340;  // along x
depth  = 800;  // along y
height = 1280;
wall   = 70;

Box(1) = {-width / 2, -depth / 2, 0, width, depth, height};
Box(2) = {-width / 2 + wall, -depth / 2 + wall, -50, width - 2 * wall, depth - 2 * wall, height + 100};
BooleanDifference(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
