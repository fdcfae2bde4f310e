// Two blocks with a gap of .02 between them. Macro mesh: each triangle is cut again by mezha.
//   gmsh -2 -format msh41 blocks.geo -o blocks.msh
// Each body has its own side of the contact, which opens or closes between them.
Mesh.Algorithm = 5;

// Lower block, body 1.
Point(1) = {0, 0, 0};
Point(2) = {2, 0, 0};
Point(3) = {2, 1, 0};
Point(4) = {0, 1, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};   // contact line
Line(4) = {4, 1};
Curve Loop(1) = {1:4};
Plane Surface(1) = {1};

// Upper block, body 2.
Point(11) = {0, 1.02, 0};
Point(12) = {2, 1.02, 0};
Point(13) = {2, 2.02, 0};
Point(14) = {0, 2.02, 0};
Line(11) = {11, 12};   // contact line
Line(12) = {12, 13};
Line(13) = {13, 14};
Line(14) = {14, 11};
Curve Loop(2) = {11:14};
Plane Surface(2) = {2};

// Edges per curve. The two sides of the contact line never match: 5 against 6.
Transfinite Curve{1} = 4 + 1;
Transfinite Curve{2} = 2 + 1;
Transfinite Curve{3} = 5 + 1;
Transfinite Curve{4} = 2 + 1;
Transfinite Curve{11} = 6 + 1;
Transfinite Curve{12} = 2 + 1;
Transfinite Curve{13} = 5 + 1;
Transfinite Curve{14} = 3 + 1;

Physical Surface("lower") = {1};
Physical Surface("upper") = {2};
Physical Curve("bottom") = {1};
Physical Curve("left") = {4, 14};   // on both bodies
Physical Curve("top") = {13};
Physical Curve("lower.seam") = {3};
Physical Curve("upper.seam") = {11};
