// A quarter of the section of a solid sphere, radius 1; x is the radius about the axis x = 0. Macro mesh: each triangle is cut again by
// mezha.
//   gmsh -2 -format msh41 sphere.geo -o sphere.msh
// Macro vertices lie on the circle itself, joined by straight chords; mezha moves the nodes that it adds onto the circle, because
// case.toml declares it as a [geometry].
Mesh.Algorithm = 5;

n = 6;   // macro edges on the arc
Point(1) = {0, 0, 0};
For i In {0:n}
  Point(100 + i) = {Cos(Pi/2 * i/n), Sin(Pi/2 * i/n), 0};
EndFor
For i In {1:n}
  Line(100 + i) = {100 + i - 1, 100 + i};
EndFor
Line(1) = {1, 100};       // y = 0
Line(2) = {100 + n, 1};   // axis
Curve Loop(1) = {1, 101:(100 + n), 2};
Plane Surface(1) = {1};

Transfinite Curve{101:(100 + n)} = 1 + 1;   // edges per curve
Transfinite Curve{1, 2} = 4 + 1;

Physical Surface("sphere") = {1};
Physical Curve("middle") = {1};
Physical Curve("skin") = {101:(100 + n)};
