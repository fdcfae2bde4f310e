// Half of a half cylinder, radius 1, on half of a block. Macro mesh: each triangle is cut again by mezha.
//   gmsh -2 -format msh41 hertz.geo -o hertz.msh
// The bodies meet at the origin and share no point. Edges grow outwards from the contact, which will be .073 wide.
// Macro vertices lie on the circle, joined by straight chords; case.toml declares the circle as a [geometry].
Mesh.Algorithm = 6;
Mesh.CharacteristicLengthExtendFromBoundary = 0;
Mesh.CharacteristicLengthFromPoints = 0;

// Block, body 1. Points 1 to 3 run along its top.
Point(1) = {0, 0, 0};
Point(2) = {0.5, 0, 0};
Point(3) = {2, 0, 0};
Point(4) = {2, -2, 0};
Point(5) = {0, -2, 0};
Line(1) = {5, 4};
Line(2) = {4, 3};
Line(3) = {3, 2};
Line(4) = {2, 1};   // may touch
Line(5) = {1, 5};   // x = 0
Curve Loop(1) = {1:5};
Plane Surface(1) = {1};

// Half of the half cylinder, body 2, centre (0, 1).
Point(11) = {0, 0, 0};
Point(12) = {0.5, 1 - Sqrt(3) / 2, 0};
Point(13) = {1, 1, 0};
Point(14) = {0, 1, 0};
Circle(11) = {11, 14, 12};   // may touch
Circle(12) = {12, 14, 13};
Line(13) = {13, 14};
Line(14) = {14, 11};         // x = 0
Curve Loop(2) = {11:14};
Plane Surface(2) = {2};

// Edge lengths: even near the contact, then growing with the distance. The two sides do not match.
Field[1] = MathEval;
Field[1].F = "0.038 + 0.5 * Max(0, Sqrt(x^2 + y^2) - 0.09)";
Field[2] = MathEval;
Field[2].F = "0.031 + 0.5 * Max(0, Sqrt(x^2 + y^2) - 0.1)";
Field[3] = Restrict;
Field[3].IField = 1;
Field[3].FacesList = {1};
Field[3].EdgesList = {1:5};
Field[4] = Restrict;
Field[4].IField = 2;
Field[4].FacesList = {2};
Field[4].EdgesList = {11:14};
Field[5] = Min;
Field[5].FieldsList = {3, 4};
Background Field = 5;

Physical Surface("block") = {1};
Physical Surface("cylinder") = {2};
Physical Curve("bottom") = {1};
Physical Curve("block.top") = {4};
Physical Curve("symmetry") = {5, 14};   // on both bodies
Physical Curve("cylinder.arc") = {11};
Physical Curve("cylinder.flank") = {12};
Physical Curve("flat") = {13};
