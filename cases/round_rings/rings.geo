// Slices of two rings, 1 <= x <= 2 and 2 <= x <= 3, 0 <= y <= .5. Macro mesh: mezha refines it.
//   gmsh -2 -format msh41 rings.geo -o rings.msh
// The bodies share no point: each has its own side of the seam. The two sides do not match.
Mesh.Algorithm = 6;

h = 0.5;
n_inner = 2;   // macro edges on each side of the seam
n_outer = 3;

// Inner ring, body 1.
Point(1) = {1, 0, 0};
Point(2) = {2, 0, 0};
Point(3) = {2, h, 0};
Point(4) = {1, h, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};   // seam
Line(3) = {3, 4};
Line(4) = {4, 1};
Curve Loop(1) = {1:4};
Plane Surface(1) = {1};

// Outer ring, body 2.
Point(11) = {2, 0, 0};
Point(12) = {3, 0, 0};
Point(13) = {3, h, 0};
Point(14) = {2, h, 0};
Line(11) = {11, 12};
Line(12) = {12, 13};
Line(13) = {13, 14};
Line(14) = {14, 11};   // seam
Curve Loop(2) = {11:14};
Plane Surface(2) = {2};

Transfinite Curve{2} = n_inner + 1;
Transfinite Curve{14} = n_outer + 1;
Transfinite Curve{1, 3} = 4 + 1;
Transfinite Curve{11, 13} = 5 + 1;
Transfinite Curve{4} = 2 + 1;
Transfinite Curve{12} = 2 + 1;

Physical Surface("inner") = {1};
Physical Surface("outer") = {2};
Physical Curve("ends") = {1, 3, 11, 13};   // of both bodies
Physical Curve("bore") = {4};
Physical Curve("inner.seam") = {2};
Physical Curve("outer.seam") = {14};
Physical Curve("rim") = {12};
