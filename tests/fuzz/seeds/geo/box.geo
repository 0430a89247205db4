SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 1, 0.1, 0.3};
Physical Volume("frame") = {1};
