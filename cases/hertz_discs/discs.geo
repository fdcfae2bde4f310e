// Quarters of two discs of radius 1 that meet at the origin. Macro mesh: each triangle is cut again by mezha.
//   gmsh -2 -format msh41 discs.geo -o discs.msh
// The bodies share no point. Edges grow outwards from the contact, which will be .05 wide.
// Macro vertices lie on the circles, joined by straight chords; case.toml declares the circles as [geometry].
Mesh.Algorithm = 6;
Mesh.CharacteristicLengthExtendFromBoundary = 0;
Mesh.CharacteristicLengthFromPoints = 0;

touching = 20 * Pi / 180;   // the part of each arc that may touch, seen from its centre

// Lower disc, body 1, centre (0, -1).
Point(1) = {0, 0, 0};
Point(2) = {0, -1, 0};
Point(3) = {1, -1, 0};
Point(4) = {Sin(touching), Cos(touching) - 1, 0};
Line(1) = {1, 2};          // x = 0
Line(2) = {2, 3};
Circle(3) = {3, 2, 4};
Circle(4) = {4, 2, 1};     // may touch
Curve Loop(1) = {1:4};
Plane Surface(1) = {1};

// Upper disc, body 2, centre (0, 1).
Point(11) = {0, 0, 0};
Point(12) = {Sin(touching), 1 - Cos(touching), 0};
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
Field[1].F = "0.026 + 0.5 * Max(0, Sqrt(x^2 + y^2) - 0.06)";
Field[2] = MathEval;
Field[2].F = "0.021 + 0.5 * Max(0, Sqrt(x^2 + y^2) - 0.07)";
Field[3] = Restrict;
Field[3].IField = 1;
Field[3].FacesList = {1};
Field[3].EdgesList = {1:4};
Field[4] = Restrict;
Field[4].IField = 2;
Field[4].FacesList = {2};
Field[4].EdgesList = {11:14};
Field[5] = Min;
Field[5].FieldsList = {3, 4};
Background Field = 5;

Physical Surface("lower") = {1};
Physical Surface("upper") = {2};
Physical Curve("symmetry") = {1, 14};   // on both bodies
Physical Curve("lower.flat") = {2};
Physical Curve("lower.flank") = {3};
Physical Curve("lower.arc") = {4};
Physical Curve("upper.arc") = {11};
Physical Curve("upper.flank") = {12};
Physical Curve("upper.flat") = {13};
