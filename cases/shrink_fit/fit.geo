// The halves of the sections of a shaft, radius 1, and of a ring around it, radii 1 to 2; x is the radius. Macro mesh: each triangle
// is cut again by mezha.
//   gmsh -2 -format msh41 fit.geo -o fit.msh
// The bodies share no point: each has its own side of the seam.
Mesh.Algorithm = 5;

// Shaft, body 1: from the axis on.
Point(1) = {0, 0, 0};
Point(2) = {1, 0, 0};
Point(3) = {1, 0.8, 0};
Point(4) = {0, 0.8, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};   // seam
Line(3) = {3, 4};
Line(4) = {4, 1};
Curve Loop(1) = {1:4};
Plane Surface(1) = {1};

// Ring, body 2.
Point(11) = {1, 0, 0};
Point(12) = {2, 0, 0};
Point(13) = {2, 0.8, 0};
Point(14) = {1, 0.8, 0};
Line(11) = {11, 12};
Line(12) = {12, 13};
Line(13) = {13, 14};
Line(14) = {14, 11};   // seam
Curve Loop(2) = {11:14};
Plane Surface(2) = {2};

// Edges per curve. The two sides of the seam do not match: 3 against 4.
Transfinite Curve{1, 3} = 3 + 1;
Transfinite Curve{2, 4} = 3 + 1;
Transfinite Curve{11, 13} = 4 + 1;
Transfinite Curve{14} = 4 + 1;
Transfinite Curve{12} = 3 + 1;

Physical Surface("shaft") = {1};
Physical Surface("ring") = {2};
Physical Curve("ends") = {1, 3, 11, 13};
Physical Curve("shaft.seam") = {2};
Physical Curve("ring.seam") = {14};
Physical Curve("rim") = {12};
