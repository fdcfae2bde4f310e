// Two bars on an inclined line, y = 3 + x/6, 0 <= x <= 6, graded to both ends of the line. Macro mesh: mezha cuts each triangle again.
//   gmsh -2 -format msh41 inclined_graded.geo -o inclined_graded.msh
Mesh.Algorithm = 6;

// Lower bar, body 1. Its side of the line is cut at x = 5 and x = 1.
Point(1) = {0, 0, 0};
Point(2) = {6, 0, 0};
Point(3) = {6, 4, 0};
Point(4) = {5, 3 + 5 / 6, 0};
Point(5) = {1, 3 + 1 / 6, 0};
Point(6) = {0, 3, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};   // contact line, from right to left
Line(4) = {4, 5};
Line(5) = {5, 6};
Line(6) = {6, 1};
Curve Loop(1) = {1:6};
Plane Surface(1) = {1};

// Upper bar, body 2, cut at x = 0.9 and x = 4.9: nothing matches.
Point(11) = {0, 3, 0};
Point(12) = {0.9, 3.15, 0};
Point(13) = {4.9, 3 + 4.9 / 6, 0};
Point(14) = {6, 4, 0};
Point(15) = {6, 6, 0};
Point(16) = {0, 6, 0};
Line(11) = {11, 12};   // contact line, from left to right
Line(12) = {12, 13};
Line(13) = {13, 14};
Line(14) = {14, 15};
Line(15) = {15, 16};
Line(16) = {16, 11};
Curve Loop(2) = {11:16};
Plane Surface(2) = {2};

// Edges per curve. A progression q makes each edge q times as long as the one before it, in the direction of the line.
Transfinite Curve{1} = 4 + 1;
Transfinite Curve{2} = 9 + 1 Using Progression 1 / 1.8;
Transfinite Curve{3} = 7 + 1 Using Progression 1.6;
Transfinite Curve{4} = 16 + 1;
Transfinite Curve{5} = 5 + 1 Using Progression 1 / 1.4;
Transfinite Curve{6} = 7 + 1 Using Progression 1.5;
Transfinite Curve{11} = 5 + 1 Using Progression 1.4;
Transfinite Curve{12} = 17 + 1;
Transfinite Curve{13} = 7 + 1 Using Progression 1 / 1.6;
Transfinite Curve{14} = 8 + 1 Using Progression 1.8;
Transfinite Curve{15} = 4 + 1;
Transfinite Curve{16} = 7 + 1 Using Progression 1 / 1.5;

Physical Surface("lower") = {1};
Physical Surface("upper") = {2};
Physical Curve("bottom") = {1};
Physical Curve("left") = {6, 16};   // on both bodies
Physical Curve("top") = {15};
Physical Curve("lower.seam") = {3:5};
Physical Curve("upper.seam") = {11:13};
