// Half of a square block, half width 1, on half of a large half-plane, x >= 0. Macro mesh: each triangle is cut again by
// mezha.
//   gmsh -2 -format msh41 punch.geo -o punch.msh
//   gmsh -2 -format msh41 -setnumber rings 6 punch.geo -o large.msh
// The bodies share no point. Around the corner of the block, (1, 0), both meshes are rings of radii that halve inwards.
Mesh.Algorithm = 6;
Mesh.CharacteristicLengthExtendFromBoundary = 0;
Mesh.CharacteristicLengthFromPoints = 0;

DefineConstant[ rings = 5 ];   // each doubles the radius of the half-plane, from 3.125: 5 give 100
levels = 9;                    // each halves the edges at the corner
r_base = 0.8;                  // radii of the outermost rings about the corner; the two sides do not match
r_block = 0.6;

// Base, body 1, around the corner. Ring k, from the outermost one: points 100 + 10 k + i, i = 0 at the contact, 3 outside.
Point(1) = {1, 0, 0};
For k In {0:levels}
  r = r_base / 2^k;
  For i In {0:3}
    angle = Pi * (1 + i / 3);
    Point(100 + 10 * k + i) = {1 + r * Cos(angle), r * Sin(angle), 0};
  EndFor
  For i In {1:3}
    Line(300 + 10 * k + i) = {100 + 10 * k + i - 1, 100 + 10 * k + i};
  EndFor
EndFor
For k In {1:levels}
  For i In {0:3}
    Line(500 + 10 * k + i) = {100 + 10 * k + i, 100 + 10 * (k - 1) + i};
  EndFor
  For i In {1:3}
    s = 500 + 10 * k + i;
    Curve Loop(s) = {500 + 10 * k + i - 1, 300 + 10 * (k - 1) + i, -(500 + 10 * k + i), -(300 + 10 * k + i)};
    Plane Surface(s) = {s};
    base[] += {s};
    ringed[] += {s};
  EndFor
  base_contact[] += {500 + 10 * k};
  radial[] += {(500 + 10 * k):(500 + 10 * k + 3)};
EndFor
For i In {0:3}
  Line(500 + i) = {1, 100 + 10 * levels + i};
EndFor
For i In {1:3}
  Curve Loop(500 + i) = {500 + i - 1, 300 + 10 * levels + i, -(500 + i)};
  Plane Surface(500 + i) = {500 + i};
  base[] += {500 + i};
EndFor

// Base, far away: rings of two sectors about (0, 0); each is twice as large as the one before. From x = 0 to y = 0.
For k In {0:rings}
  r = 3.125 * 2^k;
  For i In {0:2}
    angle = Pi / 2 * (i / 2 - 1);
    Point(1000 + 10 * k + i) = {r * Cos(angle), r * Sin(angle), 0};
  EndFor
  For i In {1:2}
    Line(2000 + 10 * k + i) = {1000 + 10 * k + i - 1, 1000 + 10 * k + i};
  EndFor
EndFor
For k In {1:rings}
  For i In {0:2}
    Line(3000 + 10 * k + i) = {1000 + 10 * (k - 1) + i, 1000 + 10 * k + i};
  EndFor
  For i In {1:2}
    s = 3000 + 10 * k + i;
    Curve Loop(s) = {2000 + 10 * (k - 1) + i, 3000 + 10 * k + i, -(2000 + 10 * k + i), -(3000 + 10 * k + i - 1)};
    Plane Surface(s) = {s};
    base[] += {s};
    ringed[] += {s};
  EndFor
  axis[] += {3000 + 10 * k};
  radial[] += {(3000 + 10 * k):(3000 + 10 * k + 2)};
EndFor

// Base, between the two.
Point(2) = {0, 0, 0};
Line(1) = {100, 2};     // may touch
Line(2) = {2, 1000};
Line(3) = {1002, 103};
Curve Loop(1) = {1, 2, 2001, 2002, 3, -303:-301};
Plane Surface(1) = {1};

// Block, body 2, around the corner. Points 4100 + 10 k + i, i = 0 at the contact, 2 on the free side.
Point(11) = {1, 0, 0};
For k In {0:levels}
  r = r_block / 2^k;
  For i In {0:2}
    angle = Pi * (1 - i / 4);
    Point(4100 + 10 * k + i) = {1 + r * Cos(angle), r * Sin(angle), 0};
  EndFor
  For i In {1:2}
    Line(4300 + 10 * k + i) = {4100 + 10 * k + i - 1, 4100 + 10 * k + i};
  EndFor
EndFor
For k In {1:levels}
  For i In {0:2}
    Line(4500 + 10 * k + i) = {4100 + 10 * k + i, 4100 + 10 * (k - 1) + i};
  EndFor
  For i In {1:2}
    s = 4500 + 10 * k + i;
    Curve Loop(s) = {4500 + 10 * k + i - 1, 4300 + 10 * (k - 1) + i, -(4500 + 10 * k + i), -(4300 + 10 * k + i)};
    Plane Surface(s) = {s};
    block[] += {s};
    ringed[] += {s};
  EndFor
  block_contact[] += {4500 + 10 * k};
  radial[] += {(4500 + 10 * k):(4500 + 10 * k + 2)};
EndFor
For i In {0:2}
  Line(4500 + i) = {11, 4100 + 10 * levels + i};
EndFor
For i In {1:2}
  Curve Loop(4500 + i) = {4500 + i - 1, 4300 + 10 * levels + i, -(4500 + i)};
  Plane Surface(4500 + i) = {4500 + i};
  block[] += {4500 + i};
EndFor

// Block, the rest.
Point(12) = {0, 0, 0};
Point(13) = {0, 2, 0};
Point(14) = {1, 2, 0};
Line(11) = {4100, 12};   // may touch
Line(12) = {12, 13};
Line(13) = {13, 14};
Line(14) = {14, 4102};
Curve Loop(2) = {11:14, -4302, -4301};
Plane Surface(2) = {2};

// Edge lengths where no ring is.
Field[1] = MathEval;
Field[1].F = "0.45 + 0.9 * Max(0, Sqrt(x^2 + y^2) - 1)";
Background Field = 1;
For k In {0:levels}
  Transfinite Curve{300 + 10 * k + 1, 300 + 10 * k + 2, 300 + 10 * k + 3} = 1 + 1;
  Transfinite Curve{4300 + 10 * k + 1, 4300 + 10 * k + 2} = 1 + 1;
EndFor
For k In {0:rings}
  Transfinite Curve{2000 + 10 * k + 1, 2000 + 10 * k + 2} = 1 + 1;
EndFor
Transfinite Curve{radial[], 500:503, 4500:4502} = 1 + 1;
Transfinite Surface{ringed[]};

Physical Surface("base") = {1, base[]};
Physical Surface("block") = {2, block[]};
Physical Curve("symmetry") = {2, 12, axis[]};   // on both bodies
Physical Curve("base.top") = {1, 500, base_contact[]};
Physical Curve("block.bottom") = {11, 4500, block_contact[]};
Physical Curve("block.top") = {13};
Physical Curve("far") = {2000 + 10 * rings + 1, 2000 + 10 * rings + 2};
