// Two layers on the line y = 0, 0 <= x <= 4: heights 0.6 below and 1 above. Macro mesh: each triangle is cut again by mezha.
//   gmsh -2 -format msh41 beam.geo -o beam.msh
// The bodies share no point: each has its own side of the contact line.
Mesh.Algorithm = 5;

// Lower layer, body 1.
Point(1) = {0, -0.6, 0};
Point(2) = {4, -0.6, 0};
Point(3) = {4, 0, 0};
Point(4) = {0, 0, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};   // contact line
Line(4) = {4, 1};
Curve Loop(1) = {1:4};
Plane Surface(1) = {1};

// Upper layer, body 2.
Point(11) = {0, 0, 0};
Point(12) = {4, 0, 0};
Point(13) = {4, 1, 0};
Point(14) = {0, 1, 0};
Line(11) = {11, 12};   // contact line
Line(12) = {12, 13};
Line(13) = {13, 14};
Line(14) = {14, 11};
Curve Loop(2) = {11:14};
Plane Surface(2) = {2};

// Edges per curve. The two sides of the contact line do not match: 9 against 7.
Transfinite Curve{1} = 8 + 1;
Transfinite Curve{2, 4} = 1 + 1;
Transfinite Curve{3} = 9 + 1;
Transfinite Curve{11} = 7 + 1;
Transfinite Curve{12, 14} = 2 + 1;
Transfinite Curve{13} = 8 + 1;

Physical Surface("lower") = {1};
Physical Surface("upper") = {2};
Physical Curve("left") = {4, 14};    // on both layers
Physical Curve("lower.left") = {4};
Physical Curve("lower.end") = {2};
Physical Curve("upper.end") = {12};
Physical Curve("top") = {13};
Physical Curve("lower.seam") = {3};
Physical Curve("upper.seam") = {11};
