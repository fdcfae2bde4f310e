// A wheel on a rail without a named curve: gmsh -2 -format msh41 no_curves.geo -o no_curves.msh
Point(11)={-4,0,0,1.6};Point(12)={4,0,0,1.6};Point(13)={4,2,0,1.6};Point(14)={-4,2,0,1.6};
Line(11)={11,12};Line(12)={12,13};Line(13)={13,14};Line(14)={14,11};
Curve Loop(11)={11:14};Plane Surface(11)={11};
Physical Surface("rail")={11};
Point(21)={0,4,0,1};Point(22)={2,4,0,1};Point(23)={0,6,0,1};Point(24)={-2,4,0,1};Point(25)={0,2,0,1};
Circle(21)={22,21,23};Circle(22)={23,21,24};Circle(23)={24,21,25};Circle(24)={25,21,22};
Curve Loop(21)={21:24};Plane Surface(21)={21};
Physical Surface("wheel")={21};
