// Half of a coated block under another block; symmetric about x = 0 and x = 1. Small triangles where the blocks meet.
//   gmsh -2 -format msh41 coating.geo -o coating.msh
Mesh.Algorithm = 6;
Mesh.MeshSizeExtendFromBoundary = 0;

t = 0.05;  w = 0.25;       // the coating is as thin as that; the blocks may touch up to x = w
Point(1) = {0, -1, 0};   Point(2) = {1, -1, 0};
Point(3) = {1, -t, 0};   Point(4) = {0, -t, 0};
Point(5) = {1, 0, 0};    Point(6) = {w, 0, 0};   Point(7) = {0, 0, 0};
Line(1) = {1, 2};  Line(2) = {2, 3};  Line(3) = {3, 4};  Line(4) = {4, 1};
Line(5) = {3, 5};  Line(6) = {5, 6};  Line(7) = {6, 7};  Line(8) = {7, 4};
Curve Loop(1) = {1, 2, 3, 4};      Plane Surface(1) = {1};
Curve Loop(2) = {-3, 5, 6, 7, 8};  Plane Surface(2) = {2};

Point(8) = {0, 0, 0};  Point(9) = {w, 0, 0};  Point(10) = {1, 0, 0};  Point(11) = {1, 1, 0};  Point(12) = {0, 1, 0};
Line(9) = {8, 9};  Line(10) = {9, 10};  Line(11) = {10, 11};  Line(12) = {11, 12};  Line(13) = {12, 8};
Curve Loop(3) = {9, 10, 11, 12, 13};  Plane Surface(3) = {3};

Field[1] = MathEval;
Field[1].F = "0.05 + 0.4*max(0, sqrt(x^2 + y^2) - 0.2)";
Field[2] = MathEval;
Field[2].F = "0.042 + 0.4*max(0, sqrt(x^2 + y^2) - 0.2)";
Field[3] = Restrict;  Field[3].InField = 2;  Field[3].SurfacesList = {3};
Field[4] = Min;  Field[4].FieldsList = {1, 3};
Background Field = 4;

Physical Surface("core") = {1};
Physical Surface("film") = {2};
Physical Surface("block") = {3};
Physical Curve("bottom") = {1};
Physical Curve("sides") = {2, 4, 5, 8, 11, 13};
Physical Curve("coated.seam") = {7};
Physical Curve("block.seam") = {9};
Physical Curve("top") = {12};
