// Half of a roller of diameter 100 on half of a block of 200 x 200, x >= 0; mm. Macro mesh: each triangle is cut again by mezha.
//   gmsh -2 -format msh41 roller.geo -o roller.msh
// The bodies meet at the origin and share no point. Edges grow outwards from the contact, which will be 6.2 wide, and from
// the load at the top. Macro vertices lie on the circle, joined by straight chords; case.toml declares the circle.
Mesh.Algorithm = 6;
Mesh.CharacteristicLengthExtendFromBoundary = 0;
Mesh.CharacteristicLengthFromPoints = 0;

touching = 20 * Pi / 180;   // the part of the rim that may touch, seen from the centre
loaded = 20 * Pi / 180;     // the part that carries the load

// Block, body 1.
Point(1) = {0, 0, 0};
Point(2) = {18, 0, 0};
Point(3) = {100, 0, 0};
Point(4) = {100, -200, 0};
Point(5) = {0, -200, 0};
Line(1) = {5, 4};
Line(2) = {4, 3};
Line(3) = {3, 2};
Line(4) = {2, 1};   // may touch
Line(5) = {1, 5};   // x = 0
Curve Loop(1) = {1:5};
Plane Surface(1) = {1};

// Half of the roller, body 2, centre (0, 50).
Point(11) = {0, 0, 0};
Point(12) = {50 * Sin(touching), 50 - 50 * Cos(touching), 0};
Point(13) = {50, 50, 0};
Point(14) = {50 * Sin(loaded), 50 + 50 * Cos(loaded), 0};
Point(15) = {0, 100, 0};
Point(16) = {0, 50, 0};
Circle(11) = {11, 16, 12};   // may touch
Circle(12) = {12, 16, 13};
Circle(13) = {13, 16, 14};
Circle(14) = {14, 16, 15};   // carries the load
Line(15) = {15, 11};         // x = 0
Curve Loop(2) = {11:15};
Plane Surface(2) = {2};

// Edge lengths: even near the contact, then growing with the distance. The two sides do not match.
Field[1] = MathEval;
Field[1].F = "Min(2.9 - 0.3 * y / Sqrt(y^2 + 1e-6) + 0.5 * Max(0, Sqrt(x^2 + y^2) - 8), 4 + 0.5 * Max(0, Sqrt(x^2 + (y - 100)^2) - 8))";
Background Field = 1;

Physical Surface("block") = {1};
Physical Surface("roller") = {2};
Physical Curve("bottom") = {1};
Physical Curve("block.top") = {4};
Physical Curve("symmetry") = {5, 15};   // on both bodies
Physical Curve("roller.arc") = {11};
Physical Curve("roller.flank") = {12, 13};
Physical Curve("roller.top") = {14};
