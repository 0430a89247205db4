// Bed of a press frame in four parts, drawn in mm: a table between two blocks that carry the columns and hold the tie
// rods from below.  x to the right, y to the rear, z up; symmetric about x = 0 and y = 0; the feet stand on z = 0.
SetFactory("OpenCASCADE");
Geometry.OCCAutoFix = 0;

half_width   = 900;
half_depth   = 400;
inner        = 560;   // half width of the table
seat_height  = 920;   // of the columns
table_height = 900;
table_bottom = 500;
rod_place    = 730;   // of the tie rods along x
rod_bore     = 90;    // radius
nut_radius   = 150;   // of the recess below for the nut
nut_height   = 100;

Box(1) = {-half_width, -half_depth, 0, half_width - inner, 2 * half_depth, seat_height};
Box(2) = {inner, -half_depth, 0, half_width - inner, 2 * half_depth, seat_height};
Box(3) = {-inner, -half_depth, table_bottom, 2 * inner, 2 * half_depth, table_height - table_bottom};
Cylinder(11) = {-rod_place, 0, -50, 0, 0, seat_height + 100, rod_bore};
Cylinder(12) = {rod_place, 0, -50, 0, 0, seat_height + 100, rod_bore};
Cylinder(13) = {-rod_place, 0, -50, 0, 0, nut_height + 50, nut_radius};
Cylinder(14) = {rod_place, 0, -50, 0, 0, nut_height + 50, nut_radius};
Cylinder(15) = {0, 0, table_bottom - 50, 0, 0, table_height, 130}; // slug hole

BooleanUnion(20)      = { Volume{1}; Delete; }{ Volume{2, 3}; Delete; };
BooleanDifference(21) = { Volume{20}; Delete; }{ Volume{11:15}; Delete; };
