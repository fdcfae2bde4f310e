// A wedge between two blocks. Macro mesh: each triangle is cut again by mezha.
//   gmsh -2 -format msh41 wedge.geo -o wedge.msh
// Its faces are 20 and 30 degrees from upright and would meet at the origin; all bodies are between y = .5 and 2.5. The bodies
// share no point.
Mesh.Algorithm = 5;

left = Tan(20 * Pi / 180);
right = Tan(30 * Pi / 180);
low = 0.5;
high = 2.5;

// Left block, body 1.
Point(1) = {-3, low, 0};
Point(2) = {-low * left, low, 0};
Point(3) = {-high * left, high, 0};
Point(4) = {-3, high, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};   // in contact
Line(3) = {3, 4};
Line(4) = {4, 1};
Curve Loop(1) = {1:4};
Plane Surface(1) = {1};

// Wedge, body 2.
Point(11) = {-low * left, low, 0};
Point(12) = {low * right, low, 0};
Point(13) = {high * right, high, 0};
Point(14) = {-high * left, high, 0};
Line(11) = {11, 12};
Line(12) = {12, 13};   // in contact with the right block
Line(13) = {13, 14};
Line(14) = {14, 11};   // in contact with the left block
Curve Loop(2) = {11:14};
Plane Surface(2) = {2};

// Right block, body 3.
Point(21) = {low * right, low, 0};
Point(22) = {3, low, 0};
Point(23) = {3, high, 0};
Point(24) = {high * right, high, 0};
Line(21) = {21, 22};
Line(22) = {22, 23};
Line(23) = {23, 24};
Line(24) = {24, 21};   // in contact
Curve Loop(3) = {21:24};
Plane Surface(3) = {3};

Transfinite Curve{2} = 4 + 1;
Transfinite Curve{14} = 5 + 1;
Transfinite Curve{12} = 6 + 1;
Transfinite Curve{24} = 5 + 1;
Transfinite Curve{11} = 1 + 1;
Transfinite Curve{13} = 5 + 1;
Transfinite Curve{1, 21} = 4 + 1;
Transfinite Curve{3, 23} = 3 + 1;
Transfinite Curve{4, 22} = 3 + 1;

Physical Surface("left") = {1};
Physical Surface("wedge") = {2};
Physical Surface("right") = {3};
Physical Curve("left.bottom") = {1};
Physical Curve("right.bottom") = {21};
Physical Curve("left.wall") = {4};
Physical Curve("right.wall") = {22};
Physical Curve("left.face") = {2};
Physical Curve("wedge.left") = {14};
Physical Curve("wedge.right") = {12};
Physical Curve("right.face") = {24};
Physical Curve("wedge.top") = {13};
Physical Curve("wedge.tip") = {11};
Physical Curve("top") = {3, 23};         // of the blocks
