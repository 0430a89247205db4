// Loom frame: two walls with the bores of crankshaft and sley shaft, cross beams between them, and the plate of the motor.
// In mm; x towards the cloth, y across the loom, z up.  It stands on z = 0 and is symmetric about y = 0 but for the plate.

SetFactory("OpenCASCADE");
Geometry.OCCAutoFix = 0;

inner = 600; // wall to y = 0
wall  = 30;  // thickness

Box(1) = {-500, inner, 0, 900, wall, 900};          // walls
Box(2) = {-500, -inner - wall, 0, 900, wall, 900};
Box(3) = {300, -inner, 700, 80, 2*inner, 120};      // breast beam
Box(4) = {-480, -inner, 780, 80, 2*inner, 100};     // back rest
Box(5) = {-320, -inner, 60, 240, 2*inner, 40};      // floor beam, carries the motor
Box(6) = {250, -inner, 60, 100, 2*inner, 60};
Cylinder(7) = {-250, -800, 750, 0, 1600, 0, 40};    // bearings of the crankshaft
Cylinder(8) = {100, -800, 250, 0, 1600, 0, 25};     // and of the sley

BooleanUnion(9)       = { Volume{1}; Delete; }{ Volume{2 : 6}; Delete; };
BooleanDifference(10) = { Volume{9}; Delete; }{ Volume{7, 8}; Delete; };
