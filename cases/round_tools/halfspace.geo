// Section of a half space below y = 0, at the right of the axis x = 0. Macro mesh: mezha refines it.
//   gmsh -2 -format msh41 halfspace.geo -o halfspace.msh
// Edges are even near the contact, which will reach to x = 1, then grow outwards. Beyond r = 3.125
// the body is rings of two sectors, each twice as large as the one before.
Mesh.Algorithm = 6;
Mesh.CharacteristicLengthExtendFromBoundary = 0;
Mesh.CharacteristicLengthFromPoints = 0;

DefineConstant[ rings = 12 ];   // each doubles the radius, from 3.125: 12 give 12 800

For b In {0:0}
  side = 2 * b - 1;
  o = 10000 * b;
  Point(o + 1) = {0, 0, 0};
  Point(o + 2) = {1.5, 0, 0};
  For k In {0:rings}
    r = 3.125 * 2^k;
    For i In {0:2}
      angle = Pi / 2 * (1 - i / 2);
      Point(o + 100 + 10 * k + i) = {r * Cos(angle), side * r * Sin(angle), 0};
    EndFor
    For i In {1:2}
      Line(o + 100 + 10 * k + i) = {o + 100 + 10 * k + i - 1, o + 100 + 10 * k + i};
    EndFor
  EndFor
  For k In {1:rings}
    For i In {0:2}
      Line(o + 500 + 10 * k + i) = {o + 100 + 10 * (k - 1) + i, o + 100 + 10 * k + i};
    EndFor
    For i In {1:2}
      s = o + 10 * k + i;
      Curve Loop(s) = {o + 100 + 10 * (k - 1) + i, o + 500 + 10 * k + i, -(o + 100 + 10 * k + i), -(o + 500 + 10 * k + i - 1)};
      Plane Surface(s) = {s};
      Transfinite Surface{s};
      body~{b}[] += {s};
    EndFor
    axis[] += {o + 500 + 10 * k};
    Transfinite Curve{(o + 500 + 10 * k):(o + 500 + 10 * k + 2)} = 1 + 1;
  EndFor
  For k In {0:rings}
    Transfinite Curve{(o + 100 + 10 * k + 1):(o + 100 + 10 * k + 2)} = 1 + 1;
  EndFor
  Line(o + 1) = {o + 1, o + 2};     // may touch
  Line(o + 2) = {o + 2, o + 102};
  Line(o + 3) = {o + 1, o + 100};
  Curve Loop(o + 1) = {o + 1, o + 2, -(o + 102), -(o + 101), -(o + 3)};
  Plane Surface(o + 1) = {o + 1};
  body~{b}[] += {o + 1};
  axis[] += {o + 3};
EndFor

// Edge lengths: even near the contact, then growing outwards.
Field[1] = MathEval;
Field[1].F = "0.28 + 0.6 * Max(0, Sqrt(x^2 + y^2) - 1.1)";
Background Field = 1;
Transfinite Curve{1} = 5 + 1;

Physical Surface("ground") = {body~{0}[]};
Physical Curve("surface") = {1};

Physical Curve("far") = {100 + 10 * rings + 1, 100 + 10 * rings + 2};
