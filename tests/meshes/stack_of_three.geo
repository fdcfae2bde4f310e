// A plate on a plate with a disc on top, of which no boundary is held: lower.top, plate.bottom, plate.top, disc.rim.
// gmsh -2 -format msh41 stack_of_three.geo -o stack_of_three.msh
SetFactory("Built-in");
Point(1) = {0, 0, 0, 1}; Point(2) = {10, 0, 0, 1}; Point(3) = {10, 2, 0, 1}; Point(4) = {0, 2, 0, 1};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1:4}; Plane Surface(1) = {1};
Point(11) = {1, 2, 0, .83}; Point(12) = {9, 2, 0, .83}; Point(13) = {9, 3.5, 0, .83}; Point(14) = {1, 3.5, 0, .83};
Line(11) = {11, 12}; Line(12) = {12, 13}; Line(13) = {13, 14}; Line(14) = {14, 11};
Curve Loop(11) = {11:14}; Plane Surface(11) = {11};
Point(21) = {5, 5, 0, .6}; Point(22) = {6.5, 5, 0, .6}; Point(23) = {5, 6.5, 0, .6}; Point(24) = {3.5, 5, 0, .6}; Point(25) = {5, 3.5, 0, .6};
Circle(21) = {22, 21, 23}; Circle(22) = {23, 21, 24}; Circle(23) = {24, 21, 25}; Circle(24) = {25, 21, 22};
Curve Loop(21) = {21:24}; Plane Surface(21) = {21};
Physical Surface("lower") = {1}; Physical Surface("plate") = {11}; Physical Surface("disc") = {21};
Physical Curve("lower.top") = {3}; Physical Curve("plate.bottom") = {11}; Physical Curve("plate.top") = {13};
Physical Curve("disc.rim") = {21:24};
