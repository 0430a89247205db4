// Chassis of a mobile crane: two longerons, cross members, a pair of plates that carries the pin of the boom, a lug for the
// luffing cylinder, pads for the axles.  In mm; x forward, z up, the origin at the height of the axles midway between them.

SetFactory("OpenCASCADE");
Geometry.OCCAutoFix = 0;

length = 5000; // of the longerons
gauge  = 500;  // half the distance of their middles
web    = 90;   // width of a longeron
low    = 200;  // lower face
high   = 560;  // upper face
axle   = 2100; // of both axles from the middle
pin_x  = -900; // pin of the boom
pin_z  = 1700;
foot_x = 500;  // foot of the cylinder
foot_z = 700;

Box(1) = {-length/2, -gauge - web/2, low, length, web, high - low};
Box(2) = {-length/2, gauge - web/2, low, length, web, high - low};
n = 3;
For i In {0 : 3}
  x = (i == 0) ? -axle : ((i == 1) ? pin_x : ((i == 2) ? foot_x : axle));
  Box(n) = {x - 100, -gauge, low + 60, 200, 2*gauge, high - low - 120};
  n += 1;
EndFor
Box(n) = {pin_x - 180, -gauge - web/2, high, 360, web, pin_z - high + 130};
Box(n+1) = {pin_x - 180, gauge - web/2, high, 360, web, pin_z - high + 130};
Box(n+2) = {foot_x - 80, -60, high - 80, 160, 120, foot_z - high + 160};
Box(n+3) = {-axle - 150, -gauge - web/2, low - 20, 300, web, 20};
Box(n+4) = {-axle - 150, gauge - web/2, low - 20, 300, web, 20};
Box(n+5) = {axle - 150, -gauge - web/2, low - 20, 300, web, 20};
Box(n+6) = {axle - 150, gauge - web/2, low - 20, 300, web, 20};
Cylinder(100) = {pin_x, -2*gauge, pin_z, 0, 4*gauge, 0, 60};
Cylinder(101) = {foot_x, -gauge/2, foot_z, 0, gauge, 0, 40};

BooleanUnion(200)      = { Volume{1}; Delete; }{ Volume{2 : n+6}; Delete; };
BooleanDifference(201) = { Volume{200}; Delete; }{ Volume{100, 101}; Delete; };
