// A box with a sphere in it: tetrahedra in two physical volumes, the sphere between them.
SetFactory("OpenCASCADE");
h = 0.5;
Box(1) = {-1, -1, -1, 2, 2, 2};
Sphere(2) = {0, 0, 0, 0.5};
v() = BooleanFragments{ Volume{1}; Delete; }{ Volume{2}; Delete; };
Mesh.MeshSizeMax = h;
sphere() = Abs(Boundary{ Volume{2}; });
box() = Abs(Boundary{ Volume{3}; });
box() -= sphere();
Physical Volume("ball") = {2};
Physical Volume("fluid") = {3};
Physical Surface("sphere") = {sphere()};
Physical Surface("far field") = {box()};
