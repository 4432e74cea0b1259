// Hexahedra and prisms side by side, of volume 2.
SetFactory("Built-in");
Point(1) = {0, 0, 0};
e[] = Extrude {1, 0, 0} { Point{1}; Layers{3}; };
f[] = Extrude {0, 1, 0} { Curve{e[1]}; Layers{3}; Recombine; };
g[] = Extrude {0, 0, 1} { Surface{f[1]}; Layers{3}; Recombine; };
t[] = Extrude {0, 1, 0} { Curve{f[0]}; Layers{3}; };
p[] = Extrude {0, 0, 1} { Surface{t[1]}; Layers{3}; Recombine; };
Physical Volume("all") = {g[1], p[1]};
Physical Surface("bottom") = {f[1], t[1]};
