// Section of the lower half of a ball of radius 1 on a round block, at the right of the axis x = 0. Macro mesh: mezha refines it.
//   gmsh -2 -format msh41 ball.geo -o ball.msh
// The bodies meet at the origin and share no point. Edges grow with the distance from the contact, which will be .02 wide.
// Macro vertices lie on the circle, joined by straight chords; case.toml declares the circle as a [geometry].
Mesh.Algorithm = 6;
Mesh.CharacteristicLengthExtendFromBoundary = 0;
Mesh.CharacteristicLengthFromPoints = 0;

// Block, body 1.
Point(1) = {0, 0, 0};
Point(2) = {1, 0, 0};
Point(3) = {1, -1, 0};
Point(4) = {0, -1, 0};
Line(1) = {4, 3};
Line(2) = {3, 2};
Line(3) = {2, 1};   // may touch
Line(4) = {1, 4};   // the axis
Curve Loop(1) = {1:4};
Plane Surface(1) = {1};

// Lower half of the ball, body 2, centre (0, 1).
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
Field[3].EdgesList = {1:4};
Field[4] = Restrict;
Field[4].IField = 2;
Field[4].FacesList = {2};
Field[4].EdgesList = {11:13};
Field[5] = Min;
Field[5].FieldsList = {3, 4};
Background Field = 5;

Physical Surface("block") = {1};
Physical Surface("ball") = {2};
Physical Curve("base") = {1};
Physical Curve("side") = {2};
Physical Curve("block.top") = {3};
Physical Curve("ball.round") = {11};
Physical Curve("ball.flat") = {12};
