// A coated block under a cap. Macro mesh: each triangle is cut again by mezha.
//   gmsh -2 -format msh41 layers.geo -o layers.msh
// Core and coating share the points and the line between them: they are one body. The cap has points of its own.
Mesh.Algorithm = 6;

Point(1) = {0, 0, 0};    Point(2) = {2, 0, 0};
Point(3) = {2, 0.7, 0};  Point(4) = {0, 0.7, 0};
Point(5) = {2, 1, 0};    Point(6) = {0, 1, 0};
Line(1) = {1, 2};  Line(2) = {2, 3};  Line(3) = {3, 4};  Line(4) = {4, 1};
Line(5) = {3, 5};  Line(6) = {5, 6};  Line(7) = {6, 4};
Curve Loop(1) = {1, 2, 3, 4};    Plane Surface(1) = {1};
Curve Loop(2) = {-3, 5, 6, 7};   Plane Surface(2) = {2};

Point(7) = {0, 1, 0};  Point(8) = {2, 1, 0};  Point(9) = {2, 2, 0};  Point(10) = {0, 2, 0};
Line(8) = {7, 8};  Line(9) = {8, 9};  Line(10) = {9, 10};  Line(11) = {10, 7};
Curve Loop(3) = {8, 9, 10, 11};  Plane Surface(3) = {3};

Transfinite Curve{1, 3} = 4 + 1;
Transfinite Curve{6} = 5 + 1;
Transfinite Curve{8} = 6 + 1;
Transfinite Curve{10} = 4 + 1;
Transfinite Curve{2, 4} = 2 + 1;
Transfinite Curve{5, 7} = 1 + 1;
Transfinite Curve{9, 11} = 3 + 1;

Physical Surface("core") = {1};
Physical Surface("layer") = {2};
Physical Surface("cap") = {3};
Physical Curve("bottom") = {1};
Physical Curve("sides") = {2, 4, 5, 7, 9, 11};
Physical Curve("between") = {3};          // nothing uses it: it may be there
Physical Curve("coated.seam") = {6};
Physical Curve("cap.seam") = {8};
Physical Curve("top") = {10};
