// Bar of 2 m x 0.2 m x 0.25 m along x, in m; clamped at x = 0.
SetFactory("OpenCASCADE");
Box(1) = {0, -0.1, -0.125, 2, 0.2, 0.25};
