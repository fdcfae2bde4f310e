// Five links: each but the first has a dovetail on its left; each but the last a neck with a round head, which lies in the
// dovetail of the next one and touches both its flanks. Edges of 3.5 at most.
//   gmsh -2 -order 2 -format msh41 chain.geo -o chain.msh
SetFactory("OpenCASCADE");
Mesh.MeshSizeMax = 3.5;
head = 24 + 2 - 2.5 + Sqrt(50);
For k In {1:5}
  x = 24 * (k - 1);
  link = 100 * k;
  Rectangle(link) = {x, -11, 0, 20, 22};
  If (k < 5)
    Rectangle(link + 1) = {x + 19, -1.5, 0, 9, 3};
    Disk(link + 2) = {x + head, 0, 0, 5};
    BooleanUnion(link + 3) = { Surface{link}; Delete; }{ Surface{link + 1, link + 2}; Delete; };
    link = link + 3;
  EndIf
  If (k > 1)
    p = newp; l = newl;
    Point(p) = {x - 1, 2.5, 0}; Point(p + 1) = {x + 2, 2.5, 0}; Point(p + 2) = {x + 5.5, 6, 0}; Point(p + 3) = {x + 13, 6, 0};
    Point(p + 4) = {x + 13, -6, 0}; Point(p + 5) = {x + 5.5, -6, 0}; Point(p + 6) = {x + 2, -2.5, 0}; Point(p + 7) = {x - 1, -2.5, 0};
    For i In {0:7}
      Line(l + i) = {p + i, p + (i + 1) % 8};
    EndFor
    Curve Loop(l) = {l:l + 7};
    Plane Surface(100 * k + 8) = {l};
    BooleanDifference(100 * k + 9) = { Surface{link}; Delete; }{ Surface{100 * k + 8}; Delete; };
    link = 100 * k + 9;
    Physical Curve(Sprintf("link%g.upper", k)) = Curve In BoundingBox {x + 1.9, 2.4, -1, x + 5.6, 6.1, 1};
    Physical Curve(Sprintf("link%g.lower", k)) = Curve In BoundingBox {x + 1.9, -6.1, -1, x + 5.6, -2.4, 1};
  EndIf
  Physical Surface(Sprintf("link%g", k)) = {link};
  If (k < 5)
    Physical Curve(Sprintf("link%g.head", k)) = Curve In BoundingBox {x + head - 5.1, -5.1, -1, x + head + 5.1, 5.1, 1};
  EndIf
EndFor
Physical Curve("left") = Curve In BoundingBox {-0.1, -11.1, -1, 0.1, 11.1, 1};
Physical Curve("right") = Curve In BoundingBox {115.9, -11.1, -1, 116.1, 11.1, 1};
