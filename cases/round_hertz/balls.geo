// Halves of two balls of radius 2, below, and 1, above: their sections at the right of the axis x = 0. Macro mesh: mezha refines it.
//   gmsh -2 -format msh41 balls.geo -o balls.msh
// The bodies meet at the origin and share no point. Edges grow with the distance from the contact, which will be .02 wide.
// Macro vertices lie on the circles, joined by straight chords; balls.toml declares the circles as [geometry].
Mesh.Algorithm = 6;
Mesh.CharacteristicLengthExtendFromBoundary = 0;
Mesh.CharacteristicLengthFromPoints = 0;

// Upper half of the lower ball, body 1, centre (0, -2).
Point(1) = {0, 0, 0};
Point(2) = {2, -2, 0};
Point(3) = {0, -2, 0};
Circle(1) = {1, 3, 2};   // may touch
Line(2) = {2, 3};
Line(3) = {3, 1};        // the axis
Curve Loop(1) = {1:3};
Plane Surface(1) = {1};

// Lower half of the upper ball, body 2, centre (0, 1).
Point(11) = {0, 0, 0};
Point(12) = {1, 1, 0};
Point(13) = {0, 1, 0};
Circle(11) = {11, 13, 12};   // may touch
Line(12) = {12, 13};
Line(13) = {13, 11};         // the axis
Curve Loop(2) = {11:13};
Plane Surface(2) = {2};

// The two sides do not match.
Field[1] = MathEval;
Field[1].F = "0.014 + 0.55 * Sqrt(x^2 + y^2)";
Field[2] = MathEval;
Field[2].F = "0.011 + 0.5 * Sqrt(x^2 + y^2)";
Field[3] = Restrict;
Field[3].IField = 1;
Field[3].FacesList = {1};
Field[3].EdgesList = {1:3};
Field[4] = Restrict;
Field[4].IField = 2;
Field[4].FacesList = {2};
Field[4].EdgesList = {11:13};
Field[5] = Min;
Field[5].FieldsList = {3, 4};
Background Field = 5;

Physical Surface("lower") = {1};
Physical Surface("upper") = {2};
Physical Curve("lower.round") = {1};
Physical Curve("lower.flat") = {2};
Physical Curve("upper.round") = {11};
Physical Curve("upper.flat") = {12};
