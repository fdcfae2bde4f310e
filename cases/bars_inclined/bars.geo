// Two bars on an inclined line, y = 3 + x/6, 0 <= x <= 6. Macro mesh: each triangle is cut again by mezha.
//   gmsh -2 -format msh41 bars.geo -o bars.msh
//   gmsh -2 -format msh41 -setnumber even 1 bars.geo -o even.msh
//   gmsh -2 -format msh41 -setnumber layers 1 bars.geo -o graded.msh
// The bodies share no point: each has its own side of the contact line.
DefineConstant[ even = 0 ];     // 0: fine towards the corner (6, 4); 1: even triangles
DefineConstant[ layers = 0 ];   // 1: halved quadrangles in layers, of one size, for mezha to grade

// Lower bar, body 1.
Point(1) = {0, 0, 0};
Point(2) = {6, 0, 0};
Point(3) = {6, 4, 0};
Point(4) = {0, 3, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};   // contact line
Line(4) = {4, 1};
Curve Loop(1) = {1:4};
Plane Surface(1) = {1};

// Upper bar, body 2.
Point(11) = {0, 3, 0};
Point(12) = {6, 4, 0};
Point(13) = {6, 6, 0};
Point(14) = {0, 6, 0};
Line(11) = {11, 12};   // contact line
Line(12) = {12, 13};
Line(13) = {13, 14};
Line(14) = {14, 11};
Curve Loop(2) = {11:14};
Plane Surface(2) = {2};

// Edges per curve. The two sides of the contact line never match: 6 against 7, or 5.
// A progression q makes each edge q times as long as the one before it, in the direction of the line.
If (layers)
  Transfinite Curve{1, 3} = 6 + 1;
  Transfinite Curve{2, 4} = 3 + 1;
  Transfinite Curve{11, 13} = 5 + 1;
  Transfinite Curve{12, 14} = 2 + 1;
  Transfinite Surface{1, 2} AlternateLeft;
ElseIf (even)
  Mesh.Algorithm = 5;
  Transfinite Curve{1} = 4 + 1;
  Transfinite Curve{2} = 2 + 1;
  Transfinite Curve{3} = 6 + 1;
  Transfinite Curve{4} = 2 + 1;
  Transfinite Curve{11} = 7 + 1;
  Transfinite Curve{12} = 1 + 1;
  Transfinite Curve{13} = 4 + 1;
  Transfinite Curve{14} = 2 + 1;
Else
  Mesh.Algorithm = 6;
  Transfinite Curve{1} = 2 + 1;
  Transfinite Curve{2} = 5 + 1 Using Progression 1 / 2.2;
  Transfinite Curve{3} = 6 + 1 Using Progression 1.9;
  Transfinite Curve{4} = 1 + 1;
  Transfinite Curve{11} = 7 + 1 Using Progression 1 / 1.7;
  Transfinite Curve{12} = 4 + 1 Using Progression 1.8;
  Transfinite Curve{13} = 2 + 1;
  Transfinite Curve{14} = 1 + 1;
EndIf

Physical Surface("lower") = {1};
Physical Surface("upper") = {2};
Physical Curve("bottom") = {1};
Physical Curve("left") = {4, 14};   // on both bodies
Physical Curve("top") = {13};
Physical Curve("lower.seam") = {3};
Physical Curve("upper.seam") = {11};
