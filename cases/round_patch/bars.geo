// Sections of two round bars of radius 1, 0 <= y <= 1 and 1 <= y <= 2, at the right of the axis x = 0. Macro mesh: mezha refines it.
//   gmsh -2 -format msh41 bars.geo -o bars.msh
// The bodies share no point: each has its own side of the seam. The two sides do not match.
Mesh.Algorithm = 6;

n_lower = 3;   // macro edges on each side of the seam
n_upper = 4;

// Lower bar, body 1.
Point(1) = {0, 0, 0};
Point(2) = {1, 0, 0};
Point(3) = {1, 1, 0};
Point(4) = {0, 1, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};   // seam
Line(4) = {4, 1};   // the axis
Curve Loop(1) = {1:4};
Plane Surface(1) = {1};

// Upper bar, body 2.
Point(11) = {0, 1, 0};
Point(12) = {1, 1, 0};
Point(13) = {1, 2, 0};
Point(14) = {0, 2, 0};
Line(11) = {11, 12};   // seam
Line(12) = {12, 13};
Line(13) = {13, 14};
Line(14) = {14, 11};   // the axis
Curve Loop(2) = {11:14};
Plane Surface(2) = {2};

Transfinite Curve{1:4} = n_lower + 1;
Transfinite Curve{11:14} = n_upper + 1;

Physical Surface("lower") = {1};
Physical Surface("upper") = {2};
Physical Curve("bottom") = {1};
Physical Curve("lower.seam") = {3};
Physical Curve("upper.seam") = {11};
Physical Curve("top") = {13};
