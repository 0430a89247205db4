// Portal: two columns on a base plate, joined by a beam, drawn in mm.  In the left head a bore carries a crank, in the
// right one a sleeve guides a slider.  x to the right, y to the rear, z up; symmetric about y = 0; it stands on z = 0.
//
//   gmsh portal_frame.geo -0 -o portal_frame.step      writes the STEP file (as mm, which is what is meant here)

SetFactory("OpenCASCADE");
Geometry.OCCAutoFix = 0;

distance      = 900;  // of the middles of the columns
width         = 140;  // of a column along x
depth         = 180;  // of columns and beam along y
height        = 1080; // top of the columns
axis_height   = 1000; // of the bores
beam_bottom   = 640;
beam_top      = 780;
base_plate    = 60;
base_margin   = 80;
bearing_bore  = 45;   // radii
guide_bore    = 50;

left  = -distance / 2;
right =  distance / 2;

Box(1) = {left - width / 2,  -depth / 2, 0,           width, depth, height};
Box(2) = {right - width / 2, -depth / 2, 0,           width, depth, height};
Box(3) = {left,              -depth / 2, beam_bottom, distance, depth, beam_top - beam_bottom};
Box(4) = {left - width / 2 - base_margin, -depth / 2 - base_margin, 0,
          distance + width + 2 * base_margin, depth + 2 * base_margin, base_plate};
Cylinder(5) = {left, -depth, axis_height, 0, 2 * depth, 0, bearing_bore};
Cylinder(6) = {right - width, 0, axis_height, 2 * width, 0, 0, guide_bore};

BooleanUnion(7)      = { Volume{1}; Delete; }{ Volume{2, 3, 4}; Delete; };
BooleanDifference(8) = { Volume{7}; Delete; }{ Volume{5, 6}; Delete; };
