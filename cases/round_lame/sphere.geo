// A quarter of the section of a thick sphere, 1 <= r <= 2, at the right of the axis x = 0. Macro mesh: mezha refines it.
//   gmsh -2 -format msh41 sphere.geo -o sphere.msh
// Macro vertices lie on the circles, joined by straight chords; case.toml declares the circles as [geometry].
Mesh.Algorithm = 6;

n_in = 4;    // macro edges on each quarter circle
n_out = 6;
For i In {0:n_in}
  Point(100 + i) = {Cos(Pi / 2 * i / n_in), Sin(Pi / 2 * i / n_in), 0};
EndFor
For i In {0:n_out}
  Point(200 + i) = {2 * Cos(Pi / 2 * i / n_out), 2 * Sin(Pi / 2 * i / n_out), 0};
EndFor
For i In {1:n_in}
  Line(100 + i) = {100 + i - 1, 100 + i};
EndFor
For i In {1:n_out}
  Line(200 + i) = {200 + i - 1, 200 + i};
EndFor
Line(1) = {100, 200};                  // y = 0
Line(2) = {200 + n_out, 100 + n_in};   // the axis
Curve Loop(1) = {1, 201:(200 + n_out), 2, -(100 + n_in):-101};
Plane Surface(1) = {1};
Transfinite Curve{101:(100 + n_in), 201:(200 + n_out)} = 1 + 1;
Transfinite Curve{1, 2} = 2 + 1;

Physical Surface("sphere") = {1};
Physical Curve("middle") = {1};
Physical Curve("in") = {101:(100 + n_in)};
Physical Curve("out") = {201:(200 + n_out)};
