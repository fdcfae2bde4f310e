// Two bars on an inclined line, y = 3 - x/6, 0 <= x <= 6. Macro mesh: four triangles in each, and mezha makes the rest.
//   gmsh -2 -format msh41 bars.geo -o bars.msh
// The bodies share no point: each has its own side of the contact line.

// Lower bar, body 1.
Point(1) = {0, 0, 0};
Point(2) = {6, 0, 0};
Point(3) = {6, 2, 0};
Point(4) = {0, 3, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};   // contact line
Line(4) = {4, 1};
Curve Loop(1) = {1:4};
Plane Surface(1) = {1};

// Upper bar, body 2.
Point(11) = {0, 3, 0};
Point(12) = {6, 2, 0};
Point(13) = {6, 6, 0};
Point(14) = {0, 6, 0};
Line(11) = {11, 12};   // contact line
Line(12) = {12, 13};
Line(13) = {13, 14};
Line(14) = {14, 11};
Curve Loop(2) = {11:14};
Plane Surface(2) = {2};

// Two halved quadrangles in each bar.
Transfinite Curve{1, 3, 11, 13} = 2 + 1;
Transfinite Curve{2, 4, 12, 14} = 1 + 1;
Transfinite Surface{1, 2};

Physical Surface("lower") = {1};
Physical Surface("upper") = {2};
Physical Curve("bottom") = {1};
Physical Curve("left") = {4, 14};   // on both bodies
Physical Curve("top") = {13};
Physical Curve("lower.seam") = {3};
Physical Curve("upper.seam") = {11};
