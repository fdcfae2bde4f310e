// Three blocks on the lines y = 1 + x/8 and y = 2.5 - x/10, 0 <= x <= 4. Macro mesh: each triangle is cut again by mezha.
//   gmsh -2 -format msh41 stack.geo -o stack.msh
// The bodies share no point: each has its own sides of the contact lines.
Mesh.Algorithm = 5;

// Lower block.
Point(1) = {0, 0, 0};
Point(2) = {4, 0, 0};
Point(3) = {4, 1.5, 0};
Point(4) = {0, 1, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};   // first contact line
Line(4) = {4, 1};
Curve Loop(1) = {1:4};
Plane Surface(1) = {1};

// Middle block.
Point(11) = {0, 1, 0};
Point(12) = {4, 1.5, 0};
Point(13) = {4, 2.1, 0};
Point(14) = {0, 2.5, 0};
Line(11) = {11, 12};   // first contact line
Line(12) = {12, 13};
Line(13) = {13, 14};   // second contact line
Line(14) = {14, 11};
Curve Loop(2) = {11:14};
Plane Surface(2) = {2};

// Upper block.
Point(21) = {0, 2.5, 0};
Point(22) = {4, 2.1, 0};
Point(23) = {4, 3.5, 0};
Point(24) = {0, 3.5, 0};
Line(21) = {21, 22};   // second contact line
Line(22) = {22, 23};
Line(23) = {23, 24};
Line(24) = {24, 21};
Curve Loop(3) = {21:24};
Plane Surface(3) = {3};

// Edges per curve. The two sides of a contact line never match: 5 against 6, and 7 against 5.
Transfinite Curve{1} = 4 + 1;
Transfinite Curve{2} = 2 + 1;
Transfinite Curve{3} = 5 + 1;
Transfinite Curve{4} = 1 + 1;
Transfinite Curve{11} = 6 + 1;
Transfinite Curve{12} = 1 + 1;
Transfinite Curve{13} = 7 + 1;
Transfinite Curve{14} = 2 + 1;
Transfinite Curve{21} = 5 + 1;
Transfinite Curve{22} = 2 + 1;
Transfinite Curve{23} = 4 + 1;
Transfinite Curve{24} = 1 + 1;

Physical Surface("lower") = {1};
Physical Surface("middle") = {2};
Physical Surface("upper") = {3};
Physical Curve("bottom") = {1};
Physical Curve("left") = {4, 14, 24};    // on all three bodies
Physical Curve("right") = {2, 12, 22};   // on all three bodies
Physical Curve("top") = {23};
Physical Curve("lower.first") = {3};
Physical Curve("middle.first") = {11};
Physical Curve("middle.second") = {13};
Physical Curve("upper.second") = {21};
