// Halves, y >= 0, of a shaft, 0 <= x <= 1, and of a ring on it, 1 <= x <= 2, y <= 1. Macro mesh: mezha refines it.
//   gmsh -2 -format msh41 shaft.geo -o shaft.msh
// The bodies share no point: each has its own side of the seam. The two sides do not match.
Mesh.Algorithm = 6;

n_shaft = 3;   // macro edges on each side of the seam
n_ring = 4;

// Shaft, body 1. Point 3 is where the ring will end.
Point(1) = {0, 0, 0};
Point(2) = {1, 0, 0};
Point(3) = {1, 1, 0};
Point(4) = {1, 3, 0};
Point(5) = {0, 3, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};   // seam
Line(3) = {3, 4};
Line(4) = {4, 5};
Line(5) = {5, 1};   // the axis
Curve Loop(1) = {1:5};
Plane Surface(1) = {1};

// Ring, body 2.
Point(11) = {1, 0, 0};
Point(12) = {2, 0, 0};
Point(13) = {2, 1, 0};
Point(14) = {1, 1, 0};
Line(11) = {11, 12};
Line(12) = {12, 13};
Line(13) = {13, 14};
Line(14) = {14, 11};   // seam
Curve Loop(2) = {11:14};
Plane Surface(2) = {2};

Transfinite Curve{1, 2} = n_shaft + 1;
Transfinite Curve{3} = 5 + 1;
Transfinite Curve{4} = 2 + 1;
Transfinite Curve{5} = 7 + 1;
Transfinite Curve{14, 11} = n_ring + 1;
Transfinite Curve{12, 13} = 3 + 1;

Physical Surface("shaft") = {1};
Physical Surface("ring") = {2};
Physical Curve("symmetry") = {1, 11};   // of both bodies
Physical Curve("shaft.seam") = {2};
Physical Curve("shaft.free") = {3};
Physical Curve("ring.seam") = {14};
