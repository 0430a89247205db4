// A quarter of a plate of 1 m x 1 m x 1 mm in hexahedra, in m: x = 0 and y = 0 are its lines of symmetry. Cells become
// narrow towards its edges, where supports hinder the contraction of the thickness within some thicknesses.
a = 0.5;
h = 0.001;
Point(1) = {0, 0, 0};
line[] = Extrude {a, 0, 0} { Point{1}; Layers{ {9, 1, 1, 1, 1, 1, 1}, {0.9, 0.95, 0.975, 0.9875, 0.99375, 0.996875, 1} }; };
face[] = Extrude {0, a, 0} { Curve{line[1]}; Layers{ {9, 1, 1, 1, 1, 1, 1}, {0.9, 0.95, 0.975, 0.9875, 0.99375, 0.996875, 1} }; Recombine; };
Extrude {0, 0, h} { Surface{face[1]}; Layers{1}; Recombine; }
Mesh 3;
