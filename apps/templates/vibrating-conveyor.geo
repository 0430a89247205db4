// Trough of a vibrating conveyor: bottom and sides, a plate for a motor on either side, a rib below the bottom and four feet
// on springs.  In mm; x along the trough, y across, z up.  Symmetric about x = 0 and y = 0; the feet stand on z = 0.

SetFactory("OpenCASCADE");
Geometry.OCCAutoFix = 0;

Box(1) = {-1000, -300, 100, 2000, 600, 15};  // bottom
Box(2) = {-1000, -300, 100, 2000, 15, 250};  // sides
Box(3) = {-1000, 285, 100, 2000, 15, 250};
Box(4) = {-120, -330, 75, 240, 30, 160};     // plates of the motors
Box(5) = {-120, 300, 75, 240, 30, 160};
Box(6) = {-60, -300, 75, 120, 600, 25};      // rib
Box(7) = {-800, -300, 0, 120, 60, 100};      // feet
Box(8) = {-800, 240, 0, 120, 60, 100};
Box(9) = {680, -300, 0, 120, 60, 100};
Box(10) = {680, 240, 0, 120, 60, 100};

BooleanUnion(11) = { Volume{1}; Delete; }{ Volume{2 : 10}; Delete; };
