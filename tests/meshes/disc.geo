// A disc of radius 1 on a block.
SetFactory("Built-in");
h = 0.7;
Point(1) = {-2, -1.5, 0, h}; Point(2) = {2, -1.5, 0, h}; Point(3) = {2, 0, 0, h}; Point(4) = {-2, 0, 0, h};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
Point(10) = {0, 1, 0, h}; Point(11) = {1, 1, 0, 0.3}; Point(12) = {0, 2, 0, h}; Point(13) = {-1, 1, 0, 0.3}; Point(14) = {0, 0, 0, 0.2};
Circle(11) = {11, 10, 12}; Circle(12) = {12, 10, 13}; Circle(13) = {13, 10, 14}; Circle(14) = {14, 10, 11};
Line(15) = {11, 10}; Line(16) = {10, 13};
Curve Loop(2) = {13, 14, 15, 16}; Plane Surface(2) = {2};
Physical Surface("block") = {1};
Physical Surface("half disc") = {2};
Physical Curve("bottom") = {1};
Physical Curve("block.top") = {3};
Physical Curve("disc.rim") = {13, 14};
Physical Curve("top") = {15, 16};
