// The half of a section of NAFEMS LE11: part of a sphere, a taper, a cylinder. Macro mesh: each triangle is cut again by mezha.
//   gmsh -2 -format msh41 le11.geo -o le11.msh
// Macro vertices lie on the circles themselves, joined by straight chords; mezha moves the nodes that it adds onto the circles,
// because case.toml declares them as [geometry].
Mesh.Algorithm = 6;

n = 4;   // macro edges on each of the arcs
For i In {0:n}
  Point(100 + i) = {Cos(Pi/4 * i/n), Sin(Pi/4 * i/n), 0};               // radius 1, up to 45 degrees
  Point(200 + i) = {1.4 * Cos(Pi/6 * i/n), 1.4 * Sin(Pi/6 * i/n), 0};   // radius 1.4, up to 30 degrees
EndFor
Point(1) = {Cos(Pi/4), 1.79, 0};
Point(2) = {1, 1.79, 0};
Point(3) = {1, 1.39, 0};
For i In {1:n}
  Line(100 + i) = {100 + i - 1, 100 + i};
  Line(200 + i) = {200 + i - 1, 200 + i};
EndFor
Line(1) = {100, 200};       // y = 0, A to B
Line(2) = {200 + n, 3};     // taper
Line(3) = {3, 2};
Line(4) = {2, 1};           // y = 1.79
Line(5) = {1, 100 + n};     // bore of the cylinder
Curve Loop(1) = {1, 201:(200 + n), 2, 3, 4, 5, -(100 + n):-101};
Plane Surface(1) = {1};

// Edges per curve.
Transfinite Curve{101:(100 + n), 201:(200 + n)} = 1 + 1;
Transfinite Curve{1} = 2 + 1;
Transfinite Curve{2} = 3 + 1;
Transfinite Curve{3, 4} = 2 + 1;
Transfinite Curve{5} = 5 + 1;

Physical Surface("solid") = {1};
Physical Curve("ends") = {1, 4};
Physical Curve("inside") = {101:(100 + n)};
Physical Curve("outside") = {201:(200 + n)};
