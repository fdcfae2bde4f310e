// Two blocks side by side on a third. Macro mesh: each triangle is cut again by mezha.
//   gmsh -2 -format msh41 blocks.geo -o blocks.msh
// The three meet at the origin and share no point; that is a vertex of the upper blocks, and inside of an edge of the lower one,
// which has 7 edges against 3 and 5; the upright line has 3 against 4.
Mesh.Algorithm = 5;

// Lower block, body 1.
Point(1) = {-2, -1.5, 0};
Point(2) = {2, -1.5, 0};
Point(3) = {2, 0, 0};
Point(4) = {-2, 0, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};   // in contact with both
Line(4) = {4, 1};
Curve Loop(1) = {1:4};
Plane Surface(1) = {1};

// Left block, body 2.
Point(11) = {-2, 0, 0};
Point(12) = {0, 0, 0};
Point(13) = {0, 1.5, 0};
Point(14) = {-2, 1.5, 0};
Line(11) = {11, 12};   // on the lower one
Line(12) = {12, 13};   // against the right one
Line(13) = {13, 14};
Line(14) = {14, 11};
Curve Loop(2) = {11:14};
Plane Surface(2) = {2};

// Right block, body 3.
Point(21) = {0, 0, 0};
Point(22) = {2, 0, 0};
Point(23) = {2, 1.5, 0};
Point(24) = {0, 1.5, 0};
Line(21) = {21, 22};   // on the lower one
Line(22) = {22, 23};
Line(23) = {23, 24};
Line(24) = {24, 21};   // against the left one
Curve Loop(3) = {21:24};
Plane Surface(3) = {3};

Transfinite Curve{3} = 7 + 1;
Transfinite Curve{1} = 5 + 1;
Transfinite Curve{2, 4} = 2 + 1;
Transfinite Curve{11, 13} = 3 + 1;
Transfinite Curve{12} = 3 + 1;
Transfinite Curve{14} = 2 + 1;
Transfinite Curve{21, 23} = 5 + 1;
Transfinite Curve{24} = 4 + 1;
Transfinite Curve{22} = 3 + 1;

Physical Surface("lower") = {1};
Physical Surface("left") = {2};
Physical Surface("right") = {3};
Physical Curve("lower.bottom") = {1};
Physical Curve("lower.right") = {2};
Physical Curve("lower.top") = {3};
Physical Curve("lower.left") = {4};
Physical Curve("left.bottom") = {11};
Physical Curve("left.right") = {12};
Physical Curve("left.top") = {13};
Physical Curve("left.left") = {14};
Physical Curve("right.bottom") = {21};
Physical Curve("right.right") = {22};
Physical Curve("right.top") = {23};
Physical Curve("right.left") = {24};
