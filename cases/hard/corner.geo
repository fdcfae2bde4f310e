// A narrow block on a wide one: its corners stand in the middle of the wide block's edges, on the file's mesh and on refined ones.
//   gmsh -2 -format msh41 corner.geo -o corner.msh
Mesh.Algorithm = 5;

// Wide block, body 1.
Point(1) = {0, 0, 0};
Point(2) = {4, 0, 0};
Point(3) = {4, 2, 0};
Point(4) = {0, 2, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};   // contact line, and the free surface beside it
Line(4) = {4, 1};
Curve Loop(1) = {1:4};
Plane Surface(1) = {1};

// Narrow block, body 2.
Point(11) = {1.13, 2, 0};
Point(12) = {2.71, 2, 0};
Point(13) = {2.71, 3.5, 0};
Point(14) = {1.13, 3.5, 0};
Line(11) = {11, 12};   // contact line
Line(12) = {12, 13};
Line(13) = {13, 14};
Line(14) = {14, 11};
Curve Loop(2) = {11:14};
Plane Surface(2) = {2};

Transfinite Curve{1} = 4 + 1;
Transfinite Curve{2, 4} = 2 + 1;
Transfinite Curve{3} = 6 + 1;
Transfinite Curve{11} = 3 + 1;
Transfinite Curve{12, 13, 14} = 2 + 1;

Physical Surface("lower") = {1};
Physical Surface("upper") = {2};
Physical Curve("bottom") = {1};
Physical Curve("left") = {4, 14};   // on both bodies
Physical Curve("top") = {13};
Physical Curve("lower.seam") = {3};
Physical Curve("upper.seam") = {11};
