// A strip on a base: right half, the left side is the plane of symmetry.
// Both lie on the line y = 2 but share no point: each body has points and lines of its own.
Point(1) = {0, 0, 0, 0.8};  Point(2) = {4, 0, 0, 0.8};  Point(3) = {4, 2, 0, 0.5};  Point(4) = {0, 2, 0, 0.2};
Line(1) = {1, 2};  Line(2) = {2, 3};  Line(3) = {3, 4};  Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4};  Plane Surface(1) = {1};

Point(5) = {0, 2, 0, 0.25};  Point(6) = {4, 2, 0, 0.4};  Point(7) = {4, 2.5, 0, 0.4};
Point(8) = {0.5, 2.5, 0, 0.25};  Point(9) = {0, 2.5, 0, 0.25};
Line(5) = {5, 6};  Line(6) = {6, 7};  Line(7) = {7, 8};  Line(8) = {8, 9};  Line(9) = {9, 5};
Curve Loop(2) = {5, 6, 7, 8, 9};  Plane Surface(2) = {2};

Physical Surface("base")  = {1};        // bodies
Physical Surface("strip") = {2};
Physical Curve("bottom")     = {1};     // boundaries that the case mentions
Physical Curve("symmetry")   = {4, 9};  // one name may cover lines of several bodies
Physical Curve("pressed")    = {8};
Physical Curve("base.seam")  = {3};
Physical Curve("strip.seam") = {5};
