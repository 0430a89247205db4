// Crown of a press frame in four parts held by tie rods, drawn in mm: a box with bosses for the crankshaft, legs that
// guide the slide, and two feet that stand on the columns.  x to the right, y to the rear, z up; symmetric about x = 0
// and y = 0; the feet stand on z = 0.
SetFactory("OpenCASCADE");
Geometry.OCCAutoFix = 0;

half_width   = 900;
half_depth   = 400;
inner        = 560;   // clear half width between the columns
height       = 700;
plate        = 100;   // thickness of front, rear, lower and upper plate
bottom       = 20;    // lower face between the feet
crank_height = 360;
bore_radius  = 120;
boss_radius  = 200;
boss_length  = 60;    // beyond the front plate
leg_length   = 500;   // of the guides below the lower face
leg          = 80;    // their thickness
leg_half     = 150;   // half of their width along y
rod_place    = 730;   // of the tie rods along x
rod_bore     = 90;    // radius
pad_radius   = 150;   // on which the nut of a tie rod rests
pad_height   = 20;

Box(1) = {-half_width, -half_depth, 0, half_width - inner, 2 * half_depth, height};
Box(2) = {inner, -half_depth, 0, half_width - inner, 2 * half_depth, height};
Box(3) = {-inner, -half_depth, bottom, 2 * inner, 2 * half_depth, height - bottom};
Cylinder(4) = {0, -half_depth - boss_length, crank_height, 0, 2 * (half_depth + boss_length), 0, boss_radius};
Box(5) = {-inner, -leg_half, bottom - leg_length, leg, 2 * leg_half, leg_length + plate};
Box(6) = {inner - leg, -leg_half, bottom - leg_length, leg, 2 * leg_half, leg_length + plate};
Cylinder(7) = {-rod_place, 0, height, 0, 0, pad_height, pad_radius};
Cylinder(8) = {rod_place, 0, height, 0, 0, pad_height, pad_radius};

Box(11) = {-inner + plate, -half_depth + plate, bottom + plate, 2 * (inner - plate), 2 * (half_depth - plate),
           height - bottom - 2 * plate};
Box(12) = {-300, -200, bottom - 50, 600, 400, plate + 100}; // for the connecting rod
Cylinder(13) = {0, -half_depth - 2 * boss_length, crank_height, 0, 2 * (half_depth + 2 * boss_length), 0, bore_radius};
Cylinder(14) = {-rod_place, 0, -50, 0, 0, height + 200, rod_bore};
Cylinder(15) = {rod_place, 0, -50, 0, 0, height + 200, rod_bore};

BooleanUnion(20)      = { Volume{1}; Delete; }{ Volume{2:8}; Delete; };
BooleanDifference(21) = { Volume{20}; Delete; }{ Volume{11:15}; Delete; };
